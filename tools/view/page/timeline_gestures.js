// SPDX-License-Identifier: BSD-3-Clause
// Pointers, wheel and keys on a timeline: the ruler moves the cursor, a drag pans, the wheel zooms about the pointer, a
// click selects an event and a double click goes to it.

class TimelineGestures {
  /** tip: the element that describes the thing under the pointer. */
  constructor(view, session, axis, clock, tip) {
    Object.assign(this, {view, session, axis, clock, tip});
    this.drag = null;
    setProperties(view.canvas, {
      onpointerdown: (event) => this.press(event),
      onpointermove: (event) => this.move(event),
      onpointerup: (event) => this.release(event),
      onpointercancel: () => (this.drag = null),
      onpointerleave: () => this.hideTip(),
      ondblclick: (event) => this.doubleClick(event),
      onwheel: (event) => this.wheel(event),
      onkeydown: (event) => this.key(event)
    });
  }

  press(event) {
    if (event.button !== 0) return;
    const at = this.view.surface.place(event);
    this.view.canvas.setPointerCapture(event.pointerId);
    this.drag = {x: at.x, y: at.y, moved: false, ruler: at.y < RULER};
    if (this.drag.ruler) this.clock.seek(this.axis.time(at.x));
  }

  move(event) {
    const at = this.view.surface.place(event),
      {drag} = this;
    if (!drag) return this.showTip(at, event);
    if (drag.ruler) return this.clock.seek(this.axis.time(at.x));
    if (!drag.moved && Math.hypot(at.x - drag.x, at.y - drag.y) < 4) return;
    drag.moved = true;
    this.hideTip();
    this.axis.pan(at.x - drag.x);
    this.view.scroller.scrollTop -= at.y - drag.y;
    drag.x = at.x;
    drag.y = at.y;
  }

  release(event) {
    const {drag} = this;
    this.drag = null;
    if (!drag || drag.moved || drag.ruler) return;
    const at = this.view.surface.place(event),
      found = this.view.at(at.x, at.y);
    if (found && found.event >= 0) this.select(found.event);
    else if (at.x > this.axis.left) this.session.selectEvent(null);
  }

  select(index) {
    const {store} = this.view.data;
    this.session.selectEvent({
      ...store.describe(index),
      line: this.view.line(),
      waker: store.waker(index) >= 0 ? store.describe(store.waker(index)) : null
    });
  }

  doubleClick(event) {
    const at = this.view.surface.place(event),
      found = this.view.at(at.x, at.y);
    if (found && found.event >= 0) this.clock.goTo(this.view.data.store.describe(found.event));
    else if (at.x > this.axis.left) this.clock.seek(this.axis.time(at.x));
  }

  wheel(event) {
    const at = this.view.surface.place(event);
    event.preventDefault();
    if (at.x < this.axis.left) this.view.scroller.scrollTop += wheelPixels(event);
    else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY))
      this.axis.pan(-(event.deltaX || event.deltaY));
    else this.axis.zoom(2 ** (-wheelPixels(event) / 200), at.x);
    this.hideTip();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    const zoom = {"+": 2, "=": 2, "-": 0.5, _: 0.5}[event.key],
      {view, session} = this;
    if (zoom) this.axis.zoom(zoom, this.middle());
    else if (event.key === "0") this.axis.showAll();
    else if (event.key === "Enter" && session.event) this.clock.goTo(session.event);
    else if (event.key === "ArrowLeft" || event.key === "ArrowRight")
      this.selectBeside(event.key === "ArrowLeft" ? -1 : 1);
    else if (event.key === "ArrowUp" || event.key === "ArrowDown") this.selectRow(event.key === "ArrowUp" ? -1 : 1);
    else return;
    view.surface.invalidate();
    event.preventDefault();
    event.stopPropagation();
  }

  /** Where keys zoom about: the selected event if it is in view, else the cursor, else the middle. */
  middle() {
    const {axis, session} = this;
    const candidates = [session.event?.time, session.time].filter(
      (time) => time !== undefined && time >= axis.from && time <= axis.to
    );
    return candidates.length ? axis.x(candidates[0]) : axis.left + axis.width / 2;
  }

  /** The next or previous event of the selected one's task; from no selection, the one at the cursor. */
  selectBeside(direction) {
    const {store} = this.view.data,
      selected = this.session.event;
    if (!store || store.count === 0) return;
    if (!selected) return this.select(Math.max(0, Math.min(store.count - 1, store.at(this.session.time))));
    const lane = store.lanes[store.byKey.get(selected.key)] ?? [],
      place = firstWhere(lane.length, (i) => lane[i] >= selected.number - store.first);
    const next = lane[place + direction];
    if (next === undefined) return;
    this.select(next);
    this.axis.reveal(store.time[next]);
  }

  selectRow(direction) {
    const {store} = this.view.data,
      selected = this.session.event;
    if (!store) return;
    if (!selected) return this.selectBeside(1);
    const rows = this.view.rows.rows.filter((row) => row.kind === "task"),
      place = rows.findIndex((row) => row.tasks[0].key === selected.key);
    for (let i = place + direction; i >= 0 && i < rows.length; i += direction) {
      const task = store.byKey.get(rows[i].tasks[0].key),
        lane = store.lanes[task] ?? [];
      if (lane.length === 0) continue;
      this.select(lane[Math.min(lane.length - 1, store.atInLane(task, selected.time))]);
      this.view.reveal(rows[i].tasks[0].key);
      return;
    }
  }

  showTip(at, event) {
    const found = at.x > this.axis.left ? this.view.at(at.x, at.y) : null,
      {store} = this.view.data,
      view = this.view;
    if (!found || !view.places || (found.row.kind === "robot" && !found.row.closed)) return this.hideTip();
    const lines =
      found.event >= 0 ? eventLines(store, found.event) : this.stateLines(found.row, this.axis.time(at.x), at.x);
    if (lines.length === 0) return this.hideTip();
    this.tip.replaceChildren(...lines.map((line) => element("div", {}, line)));
    this.tip.hidden = false;
    const {width, height} = this.tip.getBoundingClientRect();
    this.tip.style.left = `${Math.min(event.clientX + 14, innerWidth - width - 8)}px`;
    this.tip.style.top = `${event.clientY + 18 + height > innerHeight ? event.clientY - height - 12 : event.clientY + 18}px`;
  }

  hideTip() {
    this.tip.hidden = true;
  }

  /** The state of a row's task between two events about a pixel. */
  stateLines(row, time, x) {
    const {store} = this.view.data,
      {places} = this.view;
    if (row.tasks.length !== 1 || !store.byKey.has(row.tasks[0].key)) return [];
    const lane = store.lanes[store.byKey.get(row.tasks[0].key)],
      next = firstWhere(lane.length, (i) => places.of(lane[i]) > x);
    const before = next > 0 ? lane[next - 1] : -1,
      after = next < lane.length ? lane[next] : -1,
      {state, object} = stateBetween(store, before, after);
    if (!state) return [];
    const from = before >= 0 ? store.time[before] : store.from,
      to = after >= 0 ? store.time[after] : null;
    return [
      `${row.tasks[0].name}: ${state}${object >= 0 ? ` on ${store.objectText(object)}` : ""}`,
      to === null ? `since ${instantText(from)}` : `${spanText(to - from)}, from ${instantText(from)}`
    ];
  }
}

function eventLines(store, index) {
  const event = store.describe(index),
    waker = store.waker(index);
  return [
    `${event.task}: ${event.operation} ${event.object}`,
    `${instantText(event.instant)} · event ${countText(event.number)}`,
    ...(waker >= 0 ? [`woken by ${store.describe(waker).task} (${store.operationName(waker)})`] : [])
  ];
}
