// SPDX-License-Identifier: BSD-3-Clause
// The state of the page: a line of time, an instant of it, and the selection. Parts of the page read
// it, and are notified of changes by name:
//   time      the cursor, with the frame there         robot     the robot that is selected
//   run       how far the run has come; its lines       event     the event that is selected
//   layers    shown on the plan                         follow    true if the plan follows the robot
//   theme     the colours                               source    the connection
//   compare   the line beside this one                  log       lines of the log

class Session {
  constructor(source) {
    this.source = source;
    this.header = source.header;
    this.line = 0;
    this.frame = null; // the robots at the cursor
    this.robot = 0; // index in the header
    this.following = false;
    this.event = null; // as EventStore.describe gives it
    this.compared = null; // {line, frame, difference}
    this.trail = 60 * SECOND;
    this.layers = Object.fromEntries(LAYERS.map((layer) => [layer.key, layer.on]));
    this.listeners = new Map();
  }

  get time() {
    return this.frame ? this.frame.time : 0;
  }

  get lineState() {
    const {lines} = this.source.status;
    // A branch just made may be here before the status that has it.
    return lines.find((line) => line.line === this.line) ?? {from: 0, to: 0, parent: 0};
  }

  /** How far the line of time goes. A branch goes on when it is asked: at least as far as the run has come. */
  get end() {
    const {to, parent} = this.lineState;
    if (this.source.finding) return Math.max(...this.source.status.lines.map((line) => line.to));
    return parent === null ? to : Math.max(to, this.source.status.lines[0].to);
  }

  get robotName() {
    return this.header.robots[this.robot]?.name ?? "";
  }

  on(names, listener) {
    for (const name of names.split(" ")) {
      if (!this.listeners.has(name)) this.listeners.set(name, []);
      this.listeners.get(name).push(listener);
    }
  }

  changed(name) {
    for (const listener of this.listeners.get(name) ?? []) listener();
  }

  show(frame) {
    this.frame = frame;
    this.changed("time");
  }

  selectRobot(index) {
    if (index === this.robot || index < 0 || index >= this.header.robots.length) return;
    this.robot = index;
    this.changed("robot");
  }

  selectEvent(event) {
    this.event = event;
    this.changed("event");
  }

  follow(on) {
    this.following = on && this.header.robots.length > 0;
    this.changed("follow");
  }

  toggleLayer(key) {
    this.layers[key] = !this.layers[key];
    this.changed("layers");
  }
}

/** The layers of the plan, and those shown at first. */
const LAYERS = [
  {key: "grid", name: "Grid", on: true},
  {key: "furniture", name: "Furniture", on: true},
  {key: "unknown", name: "Obstacles not on the map", on: true},
  {key: "trail", name: "Trail", on: true},
  {key: "laser", name: "Laser", on: true},
  {key: "sonar", name: "Sonars", on: false},
  {key: "route", name: "Planned route", on: true},
  {key: "goals", name: "Goals", on: true},
  {key: "estimate", name: "Estimated pose", on: true},
  {key: "covariance", name: "Covariance, 3 σ", on: true},
  {key: "odometry", name: "Odometry alone", on: false},
  {key: "segments", name: "Segments mapped", on: true},
  {key: "names", name: "Names", on: true}
];
