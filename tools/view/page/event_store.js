// SPDX-License-Identifier: BSD-3-Clause
// Events of a run in columns, with an index for each task. An event is known here by its index, in the order of
// execution.

class EventStore {
  /** columns: as the protocol's "events". period_of(robot, task): the task's period or 0. */
  constructor(columns, operations) {
    const count = columns.t.length;
    this.from = columns.from;
    this.to = columns.to;
    this.complete = columns.complete;
    this.first = columns.first;
    this.operations = operations;
    this.tasks = columns.tasks.map(([number, name, robot]) => ({
      number,
      name,
      robot,
      key: `${robot}/${name}/${number}`
    }));
    this.objects = columns.objects.map(([kind, number, label, robot]) => ({kind, number, label, robot}));
    this.time = new Float64Array(count);
    this.task = Int32Array.from(columns.k);
    this.operation = Uint8Array.from(columns.o);
    this.object = Int32Array.from(columns.x);
    // Of a finding: by how much events of one instant are set apart, which were switches, which tasks wait in the end for
    // what, and the numbers of the events whose order matters.
    this.shift = columns.s ? Float64Array.from(columns.s) : null;
    this.switches = new Set(columns.switches ?? []);
    this.waits = columns.waits ? new Map(columns.waits) : null;
    this.marked = columns.marked ?? null;
    // With room behind the last event, where the tasks of a deadlock are seen waiting.
    if (this.waits) this.to += Math.max(8, Math.min(MILLISECOND, 0.05 * (this.to - this.from)));
    let time = columns.from;
    for (let i = 0; i < count; ++i) this.time[i] = time += columns.t[i];
    this.lanes = this.lanesOf(count);
    this.byKey = new Map(this.tasks.map((task, index) => [task.key, index]));
  }

  get count() {
    return this.time.length;
  }

  /** The time of an event in the run. */
  instant(index) {
    return this.time[index] - (this.shift?.[index] ?? 0);
  }

  /** For each task the indices of its events. */
  lanesOf(count) {
    const sizes = new Int32Array(this.tasks.length);
    for (let i = 0; i < count; ++i) ++sizes[this.task[i]];
    const lanes = Array.from(sizes, (size) => new Int32Array(size));
    sizes.fill(0);
    for (let i = 0; i < count; ++i) lanes[this.task[i]][sizes[this.task[i]]++] = i;
    return lanes;
  }

  /** The index of the first event at `time` or later; count if there is none. */
  at(time) {
    return firstWhere(this.count, (i) => this.time[i] >= time);
  }

  /** The place in the task's lane of its first event at `time` or later. */
  atInLane(task, time) {
    const lane = this.lanes[task];
    return firstWhere(lane.length, (i) => this.time[lane[i]] >= time);
  }

  operationName(index) {
    return this.operations[this.operation[index]];
  }

  objectText(object) {
    return object < 0 ? "" : objectText(this.objects[object]);
  }

  describe(index) {
    const task = this.tasks[this.task[index]];
    return {
      number: this.first + index,
      time: this.time[index],
      instant: this.instant(index),
      isSwitch: this.switches.has(index),
      task: task.name,
      robot: task.robot,
      key: task.key,
      taskNumber: task.number,
      operation: this.operationName(index),
      object: this.objectText(this.object[index])
    };
  }

  /**
   * The event that woke the task of event `index`, if that is a resumption: at the same instant, on the same object; or
   * -1.
   */
  waker(index) {
    if (this.operationName(index) !== "resume" || this.object[index] < 0) return -1;
    for (let i = index - 1; i >= 0 && this.instant(i) === this.instant(index); --i) {
      if (
        this.object[i] === this.object[index] &&
        this.task[i] !== this.task[index] &&
        WAKING.has(this.operationName(i))
      )
        return i;
    }
    return -1;
  }
}

/** 'mutex#44 "mailbox"', as reports have it. */
const objectText = ({kind, number, label}) => `${kind}#${number}${label ? ` "${label}"` : ""}`;

/** Operations that can end another task's wait. */
const WAKING = new Set([
  "release",
  "unlock",
  "unlock_shared",
  "notify_one",
  "notify_all",
  "send",
  "receive",
  "end",
  "timer_tick",
  "arrive",
  "count_down",
  "make_ready",
  "request_stop",
  "signal",
  "connect",
  "accept",
  "close",
  "wait",
  "store",
  "exchange",
  "compare_exchange",
  "modify"
]);

/** The least number below `count` for which the monotone `holds` is true, or count. */
function firstWhere(count, holds) {
  let low = 0,
    high = count;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (holds(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}
