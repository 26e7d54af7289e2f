// SPDX-License-Identifier: BSD-3-Clause
// The timeline of a line of time: labels of rows beside a canvas with their lanes, both as high as their window.

const RULER = 20; // pixels of the axis above the lanes

class TimelineView {
  /** host: an element that scrolls; line: gives the line of time, frame: the frame at its cursor. */
  constructor(host, session, axis, line, frame) {
    Object.assign(this, {host, session, axis, line, frame});
    this.rows = new TimelineRows(session);
    this.data = new TimelineData(session, axis, line, () => this.refresh());
    this.places = null;
    this.marks = []; // instants of interest: {time, text}
    this.canvas = element("canvas", {
      tabindex: 0,
      role: "application",
      "aria-label":
        "Timeline of tasks. Left and right select events of a task, up and down another task, plus and minus zoom.",
      "aria-describedby": "event-text"
    });
    this.labels = new TimelineLabels(this);
    this.space = element("div", {class: "lane-space"});
    this.cursor = element("div", {class: "cursor"});
    this.window = element("div", {class: "lane-window"}, this.canvas, this.cursor, this.labels.root);
    this.scroller = element("div", {class: "lane-scroller"}, this.window, this.space);
    host.append(this.scroller);
    this.surface = new Surface(this.canvas, (pen, width, height) => this.paint(pen, width, height));
    this.surface.resized = () => this.resize();
    this.scroller.addEventListener("scroll", () => this.scrolled());
    this.data.loadCounts();
    this.data.need();
    this.resize();
  }

  get top() {
    return this.scroller.scrollTop;
  }

  resize() {
    this.axis.width = Math.max(50, this.surface.width - this.axis.left - 8);
    this.scrolled();
  }

  /** New rows or data. */
  refresh() {
    this.rows.set(this.data.tasks());
    this.layOut();
  }

  layOut() {
    // The window covers the scroller's height, so the space below makes the rest.
    this.space.style.height = `${Math.max(0, this.rows.height + RULER + 4 - this.surface.height)}px`;
    this.scrolled();
  }

  scrolled() {
    this.labels.update();
    this.surface.invalidate();
  }

  viewChanged() {
    this.data.need();
    this.surface.invalidate();
  }

  paint(pen, width, height) {
    const {axis, rows} = this,
      colours = theme.colours,
      visible = rows.visible(this.top, height - RULER);
    const {store, counts} = this.data;
    pen.fillStyle = colours.floor;
    pen.fillRect(0, 0, width, height);
    const y = (row) => RULER + row.y - this.top;
    for (const row of visible)
      if (row.kind === "robot" || row.odd) {
        pen.fillStyle = colours.band;
        pen.fillRect(axis.left, y(row), width - axis.left, row.height);
      }
    // The time beyond the run, and the part not yet known, are outside.
    pen.fillStyle = colours.outside;
    pen.fillRect(axis.x(axis.end), RULER, Math.max(0, width - axis.x(axis.end)), height);
    pen.save();
    pen.beginPath();
    pen.rect(axis.left, 0, width - axis.left, height);
    pen.clip();
    const begin = store ? store.at(axis.from) : 0,
      end = store ? store.at(axis.to + 1) : 0;
    const few =
      store &&
      end - begin <= MOST_EVENTS &&
      (store.complete || store.to >= axis.to) &&
      this.data.covers(axis.from, axis.to);
    this.places = few ? new EventPlaces(store, axis, begin, end) : null;
    axis.draw(pen, RULER, true);
    pen.beginPath();
    pen.rect(axis.left, RULER, width - axis.left, height - RULER);
    pen.clip();
    axis.draw(pen, height, false);
    if (few) this.paintEvents(pen, visible, y, end - begin);
    else this.paintDensities(pen, visible, y);
    if (counts)
      for (const row of visible)
        if (row.tasks.length > 1 ? row.closed : true)
          if (!few) drawMissed(pen, counts, row.tasks, axis, y(row), row.height);
    this.marks.forEach((mark, slot) => this.paintMark(pen, mark, slot, y, height));
    pen.restore();
    this.moveCursor();
  }

  paintMark(pen, mark, slot, y, height) {
    const known = this.places && mark.number !== undefined,
      x = known ? this.places.of(mark.number - this.data.store.first) : this.axis.x(mark.time),
      row = mark.pair === undefined ? null : this.rows.rowOf.get(mark.key);
    drawMark(pen, x, height, mark.text, markColour(mark), slot);
    if (row) drawBadge(pen, x, y(row) + row.height / 2, mark);
  }

  /** The cursor's line is an element: it moves without painting the lanes again. */
  moveCursor() {
    placeCursor(this.cursor, this.axis, this.cursorX());
  }

  paintEvents(pen, visible, y, count) {
    const {axis, places} = this,
      {store} = this.data;
    pen.fillStyle = theme.colours.instant;
    for (const instant of places.instants)
      pen.fillRect(instant.x - 3, RULER, instant.end - instant.x + 2, this.surface.height);
    for (const row of visible) {
      if (row.kind === "robot" && !row.closed) continue;
      for (const task of row.tasks) {
        const index = store.byKey.get(task.key),
          quiet = this.data.quiet(task.key),
          period = this.periodOf(task);
        if (quiet) drawQuietLane(pen, axis, quiet, store.from, period, y(row), row.height);
        if (index === undefined) continue;
        drawLane(pen, store, places, axis, index, period, y(row), row.height, row.tasks.length > 1);
        if (count < 3000) drawTicks(pen, store, places, axis, index, y(row), row.height);
      }
    }
    if (count < 3000) this.paintArrows(pen, y);
    this.paintSelection(pen, y);
  }

  paintArrows(pen, y) {
    const {places, rows} = this,
      {store} = this.data;
    for (let i = places.begin; i < places.end; ++i) {
      const waker = store.waker(i);
      if (waker < 0) continue;
      const from = rows.rowOf.get(store.tasks[store.task[waker]].key),
        to = rows.rowOf.get(store.tasks[store.task[i]].key);
      if (!from || !to || from === to) continue;
      const number = this.session.event?.number,
        strong = number === store.first + i || number === store.first + waker;
      const down = to.y > from.y;
      drawArrow(
        pen,
        places.of(waker),
        y(from) + from.height * (down ? 0.8 : 0.2),
        places.of(i),
        y(to) + to.height * (down ? 0.2 : 0.8),
        strong
      );
    }
  }

  paintSelection(pen, y) {
    const event = this.session.event,
      {store} = this.data;
    const index = event && event.line === this.line() ? event.number - store.first : -1;
    if (index < 0 || index >= store.count || store.time[index] !== event.time) return;
    const row = this.rows.rowOf.get(event.key),
      x = this.places.of(index);
    if (!row) return;
    pen.strokeStyle = theme.colours.select;
    pen.lineWidth = 2;
    pen.strokeRect(x - 4, y(row) + 1, 8, row.height - 2);
  }

  paintDensities(pen, visible, y) {
    const {store, counts} = this.data;
    const lanes = visible
      .filter((row) => row.kind !== "robot" || row.closed)
      .map((row) => ({row, numbers: densityOf(row.tasks, store, counts, this.axis)}));
    // One measure for all, so that lanes can be compared.
    const greatest = lanes.reduce(
      (most, {numbers}) => numbers.reduce((least, {count}) => Math.max(least, count), most),
      1
    );
    for (const {row, numbers} of lanes) drawDensity(pen, this.axis, numbers, y(row), row.height, greatest);
  }

  /** The cursor is behind the last event that has been executed, where events of its instant are set apart. */
  cursorX() {
    const frame = this.frame(),
      {store} = this.data;
    if (!frame) return -1;
    const last = store && this.places ? frame.events - store.first : -1;
    if (last >= 0 && last < store.count && store.time[last] === frame.time)
      return this.places.of(last) + (this.places.instants.length ? 3 : 0);
    return this.axis.x(frame.time);
  }

  periodOf(task) {
    this.periods ??= new Map(
      this.session.header.robots.flatMap((robot) =>
        (robot.modules ?? []).flatMap((module) =>
          module.tasks.map((one) => [`${robot.name}/${module.name}.${one.name}`, one.period])
        )
      )
    );
    return this.periods.get(`${task.robot}/${task.name}`) ?? 0;
  }

  /** Scrolls to a task's row. */
  reveal(key) {
    const row = this.rows.rowOf.get(key),
      room = this.surface.height - RULER;
    if (row && (row.y < this.top || row.y + row.height > this.top + room)) this.scroller.scrollTop = row.y - room / 3;
  }

  /** The task's row and the event nearest to a pixel: {row, task, event index or -1}. */
  at(x, y) {
    const row = y < RULER ? null : this.rows.at(y - RULER + this.top),
      {store} = this.data;
    if (!row) return null;
    let best = -1,
      distance = 7;
    if (this.places && (row.kind !== "robot" || row.closed)) {
      for (const task of row.tasks) {
        const lane = store.lanes[store.byKey.get(task.key)] ?? [];
        for (
          let i = Math.max(0, firstWhere(lane.length, (k) => lane[k] >= this.places.begin) - 1);
          i < lane.length && lane[i] < this.places.end;
          ++i
        ) {
          const away = Math.abs(this.places.of(lane[i]) - x);
          if (away < distance) [best, distance] = [lane[i], away];
        }
      }
    }
    return {row, event: best};
  }
}
