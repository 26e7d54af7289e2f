// SPDX-License-Identifier: BSD-3-Clause
// Drawing of the timeline's lanes: states and events if they are few, their density if they are many.

const MOST_APART = 160; // events in view, up to which those of an instant are set apart

/**
 * Places of events on the axis. Events of one instant have one time; where there is room before the next instant, they are set
 * apart in the order of their execution.
 */
class EventPlaces {
  constructor(store, axis, begin, end) {
    Object.assign(this, {store, axis, begin, end});
    this.x = new Float64Array(Math.max(0, end - begin));
    this.instants = []; // those set apart: {x, end}
    // In a wider view the places would look like times.
    const close = end - begin <= MOST_APART;
    for (let i = begin; i < end;) {
      let next = i + 1;
      while (next < end && store.time[next] === store.time[i]) ++next;
      const x = axis.x(store.time[i]),
        room = (next < store.count ? axis.x(store.time[next]) : axis.left + axis.width) - x;
      const apart = close ? Math.min(8, (0.8 * Math.min(room, axis.width)) / (next - i)) : 0;
      if (apart >= 1.5 && next - i > 1) this.instants.push({x, end: x + apart * (next - i)});
      for (let k = i; k < next; ++k) this.x[k - begin] = apart >= 1.5 ? x + apart * (k - i) : x;
      i = next;
    }
  }

  of(index) {
    return index >= this.begin && index < this.end ? this.x[index - this.begin] : this.axis.x(this.store.time[index]);
  }
}

function stateFill(pen, state) {
  const colour = theme.colours[state];
  return STATES[state].pattern ? hatch(pen, STATES[state].pattern, colour, theme.colours[`${state}Ground`]) : colour;
}

/** A task's states between its events, and their ticks. period: of the task, or 0. */
function drawLane(pen, store, places, axis, task, period, top, height, thin) {
  const lane = store.lanes[task],
    begin = Math.max(0, store.atInLane(task, axis.from) - 1),
    left = axis.left,
    right = axis.left + axis.width;
  const middle = top + height / 2,
    body = thin ? height * 0.4 : height * 0.62;
  let activation = period > 0 ? activationBefore(store, lane, begin) : null,
    workedTo = -Infinity;
  const draw = (before, after, from, to) => {
    const x0 = Math.max(left, from),
      x1 = Math.min(right, to),
      small = x1 - x0 < 0.5;
    if (x1 < left || x0 > right || x1 < x0) return;
    const {state, object} = stateBetween(store, before, after),
      waits = state === "idle" || state === "blocked";
    // Waits shorter than a pixel are left out. Work is not, however short: a pixel has some or none.
    if (!state || (small && (waits || before < 0 || store.time[after] === store.time[before] || x0 < workedTo))) return;
    if (!waits) workedTo = Math.max(x1, x0 + 1.5);
    if (waits) return drawWait(pen, state, thin ? "" : store.objectText(object), x0, x1, middle, body * 0.5);
    const end = after >= 0 ? store.time[after] : axis.to,
      isLate = period > 0 && activation !== null && end > activation + period;
    drawWork(pen, state, x0, x1, isLate ? axis.x(activation + period) : null, middle, body);
  };
  if (begin === 0 && lane.length > 0) draw(-1, lane[0], axis.x(store.from), places.of(lane[0]));
  for (let i = begin; i < lane.length; ++i) {
    const event = lane[i],
      after = i + 1 < lane.length ? lane[i + 1] : -1,
      changed = period > 0 ? activationFrom(store, lane, i) : undefined;
    if (changed !== undefined) activation = changed;
    draw(event, after, places.of(event), after >= 0 ? places.of(after) : axis.x(store.to));
    if (store.time[event] > axis.to) break;
  }
}

/** A span in which a task works. late: the place from which on it does so after its period, or null. */
function drawWork(pen, state, x0, x1, late, middle, body) {
  pen.fillStyle = stateFill(pen, state);
  pen.fillRect(x0, middle - body / 2, Math.max(1.5, x1 - x0), body);
  if (late === null) return;
  const from = Math.max(x0, Math.min(late, x1));
  pen.fillStyle = stateFill(pen, "late");
  pen.fillRect(from, middle - body / 2, Math.max(2, x1 - from), body);
}

/** A span in which a task is idle, or blocked on the object of the text. */
function drawWait(pen, state, text, x0, x1, middle, size) {
  if (state === "idle") {
    pen.fillStyle = theme.colours.idle;
    pen.fillRect(x0, middle - 0.75, x1 - x0, 1.5);
    return;
  }
  pen.fillStyle = stateFill(pen, "blocked");
  pen.fillRect(x0, middle - size / 2, x1 - x0, size);
  if (text && x1 - x0 > 80) laneText(pen, text, x0 + 6, middle, x1 - x0 - 12);
}

/** The whole lane of a task without events from `since` on, by its state at the cursor. period: of the task, or 0. */
function drawQuietLane(pen, axis, task, since, period, top, height) {
  const right = axis.left + axis.width,
    middle = top + height / 2;
  if (task.quiet === "running") {
    const isLate = period > 0 && task.local > since + period,
      end = Math.min(right, axis.x(task.local));
    if (end > axis.left)
      drawWork(pen, "running", axis.left, end, isLate ? axis.x(since + period) : null, middle, height * 0.62);
  } else if (task.quiet) {
    const text = task.object ? objectText(task.object) : task.operation;
    drawWait(pen, task.quiet, text, axis.left, right, middle, height * 0.31);
  }
}

/** A text on the ground of the lane, which interrupts the drawing below it; none if there is no room. */
function laneText(pen, text, x, y, room) {
  pen.font = "11px system-ui, sans-serif";
  const width = pen.measureText(text).width + 8;
  if (width > room) return;
  pen.fillStyle = theme.colours.floor;
  pen.fillRect(x, y - 7, width, 14);
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillStyle = theme.colours.dim;
  pen.fillText(text, x + 4, y + 0.5);
}

/** A line for each event; of those closer than three pixels the first. */
function drawTicks(pen, store, places, axis, task, top, height) {
  const lane = store.lanes[task],
    middle = top + height / 2;
  pen.fillStyle = theme.colours.text;
  for (let i = store.atInLane(task, axis.from), last = -9; i < lane.length && store.time[lane[i]] <= axis.to; ++i) {
    const x = places.of(lane[i]);
    if (x - last < 3) continue;
    pen.fillRect(x - 0.5, middle - height * 0.34, 1, height * 0.68);
    last = x;
  }
}

/** Events a pixel, as the height of a bar. at(x): the number of events before that pixel. */
function drawDensity(pen, axis, numbers, top, height, greatest) {
  pen.fillStyle = theme.colours.running;
  pen.globalAlpha = 0.75;
  for (const {x, width, count} of numbers) {
    const part = Math.sqrt(count / greatest) * (height - 4);
    if (count > 0) pen.fillRect(x, top + height - 2 - Math.max(1.5, part), width, Math.max(1.5, part));
  }
  pen.globalAlpha = 1;
}

/**
 * The numbers for drawDensity of some tasks: of the store if it has all events in view, else of the counts by period.
 */
function densityOf(tasks, store, counts, axis) {
  const numbers = [],
    step = 2;
  if (store && store.complete && store.from <= Math.max(0, axis.from) && store.to >= Math.min(axis.to, axis.end)) {
    const lanes = tasks.map((task) => store.byKey.get(task.key)).filter((task) => task !== undefined);
    const before = (x) => lanes.reduce((sum, task) => sum + store.atInLane(task, axis.time(x)), 0);
    for (let x = axis.left, was = before(x); x < axis.left + axis.width; x += step) {
      const is = before(x + step);
      numbers.push({x, width: step, count: is - was});
      was = is;
    }
    return numbers;
  }
  if (!counts) return numbers;
  const rows = tasks
    .map((task) => counts.byKey.get(task.key))
    .filter((row) => row !== undefined)
    .map((row) => counts.events[row]);
  const first = Math.max(0, Math.floor((axis.from - counts.from) / counts.period)),
    last = Math.ceil((axis.to - counts.from) / counts.period);
  const merge = Math.max(1, Math.ceil(step / (axis.x(counts.period) - axis.x(0))));
  for (let i = first - (first % merge); i < last; i += merge) {
    let count = 0;
    for (const row of rows) for (let k = i; k < i + merge; ++k) count += row[k] ?? 0;
    const x = Math.max(axis.left, axis.x(counts.from + i * counts.period)),
      end = Math.min(axis.left + axis.width, axis.x(counts.from + (i + merge) * counts.period));
    if (end > x) numbers.push({x, width: end - x, count: count / merge});
  }
  return numbers;
}

/** Marks of deadlines that were missed, at wide zoom. */
function drawMissed(pen, counts, tasks, axis, top, height) {
  pen.fillStyle = theme.colours.late;
  for (const task of tasks) {
    const missed = counts.missed?.[counts.byKey.get(task.key)] ?? [];
    missed.forEach((count, i) => {
      const x = axis.x(counts.from + i * counts.period);
      if (count > 0 && x > axis.left - 2 && x < axis.left + axis.width)
        pen.fillRect(x, top + 1, Math.max(3, axis.x(counts.period) - axis.x(0)), 4);
    });
  }
}

/** From a task that wakes to the one that resumes. */
function drawArrow(pen, x0, y0, x1, y1, strong) {
  const bend = Math.max(6, Math.min(30, Math.abs(y1 - y0) / 3)),
    direction = Math.sign(y1 - y0) || 1;
  pen.strokeStyle = pen.fillStyle = strong ? theme.colours.select : theme.colours.arrow;
  pen.globalAlpha = strong ? 1 : 0.65;
  pen.lineWidth = strong ? 2 : 1;
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.bezierCurveTo(x0 + bend / 3, y0 + direction * bend, x1, y1 - direction * bend, x1, y1);
  pen.stroke();
  pen.beginPath();
  (pen.moveTo(x1, y1), pen.lineTo(x1 - 3, y1 - direction * 6), pen.lineTo(x1 + 3, y1 - direction * 6));
  pen.fill();
  pen.globalAlpha = 1;
}

const markColour = ({pair}) => (pair === 1 ? theme.colours.select : theme.colours.late);

/** An instant of interest over all lanes. slot: of its text, above those of others at the lower edge. */
function drawMark(pen, x, height, text, colour, slot) {
  pen.strokeStyle = colour;
  pen.lineWidth = 2;
  pen.setLineDash([6, 3]);
  pen.beginPath();
  pen.moveTo(Math.round(x), RULER);
  pen.lineTo(Math.round(x), height);
  pen.stroke();
  pen.setLineDash([]);
  pen.textAlign = "left";
  pen.font = "12px system-ui, sans-serif";
  haloText(pen, text, x + 5, height - 10 - 15 * slot);
}

/** The letter of an event whose order matters, at its place in its lane. */
function drawBadge(pen, x, y, {pair}) {
  pen.fillStyle = markColour({pair});
  pen.beginPath();
  pen.arc(x, y, 8, 0, 2 * Math.PI);
  pen.fill();
  pen.fillStyle = theme.colours.floor;
  pen.font = "bold 11px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillText(PAIR[pair], x, y + 0.5);
}
