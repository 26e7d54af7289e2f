// SPDX-License-Identifier: BSD-3-Clause
// The events that the timeline needs for its view: those of a recorded run are all there, those of a live one are asked
// for.

const MOST_EVENTS = 30000; // beyond it, lanes show densities

class TimelineData {
  constructor(session, axis, line, changed) {
    Object.assign(this, {session, axis, line, changed});
    this.store = null;
    this.counts = null;
    this.states = null; // of tasks, by key
    this.asked = null; // the view of a question under way
    this.state = "";
  }

  async loadCounts() {
    const counts = await this.session.source.counts(this.line()).catch(() => null);
    if (counts)
      counts.byKey = new Map(counts.tasks.map(([number, name, robot], i) => [`${robot}/${name}/${number}`, i]));
    this.counts = counts;
    this.changed();
    this.need();
  }

  forget() {
    this.store = this.counts = null;
    this.need();
    this.loadCounts();
  }

  /** All tasks that are known, by the store and the counts. */
  tasks() {
    const found = new Map();
    for (const [number, name, robot] of this.counts?.tasks ?? [])
      found.set(`${robot}/${name}/${number}`, {number, name, robot, key: `${robot}/${name}/${number}`});
    for (const task of this.store?.tasks ?? []) found.set(task.key, task);
    const places = new Map(this.session.header.robots.map((robot, i) => [robot.name, i + 1]));
    // The environment comes first, then robots as the header has them, then tasks in the order of their making.
    return [...found.values()].sort(
      (one, other) => (places.get(one.robot) ?? 0) - (places.get(other.robot) ?? 0) || one.number - other.number
    );
  }

  covers(from, to) {
    // Nothing more is known of a finding.
    if (this.session.source.finding) return this.store !== null;
    const end = this.axis.end;
    return this.store && this.store.from <= Math.max(0, from) && this.store.to >= Math.min(to, end);
  }

  /** Asks for the events in view, with a margin, unless they are there or the counts tell that they are too many. */
  async need() {
    const {source} = this.session,
      {from, to, span} = this.axis;
    // Without the counts of a live run they might be too many.
    if (source.kind === "live" && !this.counts) return;
    if (this.covers(from, to) || this.asked || this.tooMany(from, to)) return;
    const wanted = {from: Math.max(0, Math.floor(from - span / 2)), to: Math.ceil(to + span / 2)};
    this.asked = wanted;
    try {
      const store = await source.events(this.line(), wanted.from, wanted.to, MOST_EVENTS);
      // Too many for all: the view alone, of which the rest is drawn as density.
      this.store =
        store.complete || source.kind === "recorded"
          ? store
          : await source.events(this.line(), Math.max(0, Math.floor(from)), Math.ceil(to), MOST_EVENTS);
      this.state = "";
      if (source.kind === "live") {
        await this.loadStates();
        await this.widen();
      }
    } catch (error) {
      this.state = error.message;
    }
    this.asked = null;
    this.changed();
    // The view may have moved meanwhile; an answer that did not cover it is not asked for again and again.
    if (this.store && (this.axis.from !== from || this.axis.to !== to)) this.need();
  }

  /** The states at the cursor, for tasks that have no event in the store: they are in the same state all the time. */
  async loadStates() {
    const {session, store} = this,
      {time} = session;
    if (this.line() !== session.line || time < store.from || time > store.to) return (this.states = null);
    const tasks = await session.source.tasks(session.line);
    this.states = new Map(
      tasks.map((task) => [
        `${task.robot}/${task.name}/${task.number}`,
        {...task, quiet: quietState(task, time)}
      ])
    );
  }

  /** The state at the cursor of a task that has no event in the store. */
  quiet(key) {
    const index = this.store.byKey.get(key);
    return index === undefined || this.store.lanes[index].length === 0 ? this.states?.get(key) : undefined;
  }

  /** Of tasks that compute all the time, also the events before and after: they show if it is too long. */
  async widen() {
    const busy = [...(this.states ?? [])]
      .filter(([key, {quiet}]) => quiet === "running" && this.quiet(key))
      .map(([, task]) => task);
    if (busy.length === 0 || !this.store.complete) return;
    const from = Math.max(0, this.store.from - SECOND),
      to = Math.max(this.store.to, ...busy.map((task) => task.local + 1));
    const store = await this.session.source.events(this.line(), from, to, MOST_EVENTS);
    if (store.complete) this.store = store;
  }

  tooMany(from, to) {
    if (!this.counts || this.session.source.kind === "recorded") return false;
    const {period, from: begin, events} = this.counts,
      first = Math.max(0, Math.floor((from - begin) / period)),
      end = Math.ceil((to - begin) / period);
    let sum = 0;
    for (const row of events) for (let i = first; i < Math.min(end, row.length); ++i) sum += row[i];
    return sum * Math.min(1, (to - from) / ((end - first) * period)) > MOST_EVENTS;
  }
}
