// SPDX-License-Identifier: BSD-3-Clause
// A run in the program at the other end of the connection. It has the methods of RecordedSource.

class LiveSource {
  static async open(url) {
    const source = new LiveSource();
    source.connection = new Connection(
      url,
      (data) => source.message(data),
      () => source.connectionChanged()
    );
    await source.connection.open();
    source.header = withTypes(await source.askHeader());
    source.control = source.header.control === true;
    source.known = true;
    return source;
  }

  constructor() {
    this.kind = "live";
    this.header = null;
    this.control = false;
    this.log = [];
    this.status = {
      time: 0,
      events: 0,
      over: false,
      outcome: "",
      summary: "",
      digest: "",
      speed: 0,
      paused: false,
      lines: [{line: 0, from: 0, parent: null, name: "run", to: 0}]
    };
    this.listeners = new Map();
    this.kept = new Map(); // by line and robot: parts that frames leave out as unchanged
    this.places = new Map(); // by line: places that frames had, for trails
    this.obstacles = new Map();
    this.following = null;
    this.detail = {};
  }

  on(name, listener) {
    this.listeners.set(name, listener);
  }

  tell(name, value) {
    this.listeners.get(name)?.(value);
  }

  message(data) {
    if (data.kind === "frame") this.tell("frame", this.completed(data));
    else if (data.kind === "status") {
      this.status = {...this.status, ...data};
      this.tell("status");
    } else if (data.kind === "log") {
      this.log.push(...data.lines);
      if (this.log.length > 20000) this.log.splice(0, this.log.length - 20000);
      this.tell("log");
    }
  }

  /** The program sends the whole log right after the header, so earlier lines are dropped. */
  async askHeader() {
    const header = await this.connection.ask("header");
    this.log = [];
    return header;
  }

  async connectionChanged() {
    if (this.connection.state === "open" && this.known) {
      // The program may be another one by now, and the page's contents wrong.
      const header = await this.askHeader().catch(() => null);
      if (header && (header.scenario !== this.header.scenario || header.seed !== this.header.seed))
        return location.reload();
      if (this.following) this.connection.ask("follow", this.following).catch(() => {});
    }
    this.tell("connection");
  }

  /**
   * Begins or ends the pushing of frames, of the visible part only. robot: the only one whose measurements and intentions are
   * wanted; null: all of them.
   */
  follow(on, {view = null, scans = true, robot = null, rate = 30} = {}) {
    const wanted = {on, rate, view, scans, robot};
    this.detail = {robot};
    if (JSON.stringify(wanted) === JSON.stringify(this.following)) return;
    this.following = wanted;
    this.connection.ask("follow", wanted).catch(() => {});
  }

  completed(frame) {
    const {line} = frame;
    if (!this.kept.has(line))
      (this.kept.set(
        line,
        this.header.robots.map(() => ({}))
      ),
        this.places.set(
          line,
          this.header.robots.map(() => [])
        ));
    if (frame.whole) {
      this.obstacles.delete(line);
      for (const kept of this.kept.get(line)) for (const name of Object.keys(kept)) delete kept[name];
    }
    if (frame.obstacles) this.obstacles.set(line, frame.obstacles);
    else frame.obstacles = this.obstacles.get(line) ?? this.header.obstacles;
    frame.robots.forEach((robot, index) => {
      if (!robot) return;
      carryOver(this.kept.get(line)[index], robot);
      this.remember(this.places.get(line)[index], frame.time, robot.truth);
    });
    return frame;
  }

  /** Keeps places in the order of time, at most one in 50 ms. */
  remember(places, time, truth) {
    const after = firstWhere(places.length, (i) => places[i].time >= time),
      close = 50 * MILLISECOND;
    if ((places[after] && places[after].time - time < close) || (after > 0 && time - places[after - 1].time < close))
      return;
    places.splice(after, 0, {time, truth});
    if (places.length > 20000) places.splice(0, 2000);
  }

  async frame(line, time) {
    return this.completed(await this.connection.ask("seek", {line, time, ...this.detail}));
  }

  async step(line, count, task) {
    const frame = this.completed(await this.connection.ask("step", {line, count, task, ...this.detail}));
    return {...frame, event: frame.event ?? null};
  }

  async events(line, from, to, most) {
    return new EventStore(await this.connection.ask("events", {line, from, to, most}), this.header.operations);
  }

  async counts(line) {
    return this.connection.ask("counts", {line});
  }

  async tasks(line) {
    return (await this.connection.ask("tasks", {line})).tasks;
  }

  async modules(line, robot) {
    return this.connection.ask("modules", {line, robot});
  }

  /** Numbers in posters, by the shapes that the header has. */
  plottable() {
    const found = [];
    this.header.robots.slice(0, 50).forEach((robot, index) => {
      const visit = (poster, shape, path) => {
        if (shape.kind === "value") found.push({robot: index, poster: poster.name, field: path.join(".")});
        else if (shape.kind === "record") for (const part of shape.parts) visit(poster, part, [...path, part.name]);
      };
      for (const poster of robot.posters ?? []) visit(poster, poster.fields, []);
    });
    return found;
  }

  async plot(line, {robot, poster, field}, from, to, points) {
    return this.connection.ask("plot", {line, robot, poster, field, from, to, points});
  }

  /** The places before `time` as far as they are known without a gap: after a seek there are few. */
  trail(line, robot, time, span) {
    const places = this.places.get(line)?.[robot] ?? [],
      end = firstWhere(places.length, (i) => places[i].time > time);
    let begin = Math.max(0, end - 1);
    while (begin > 0 && places[begin].time - places[begin - 1].time < SECOND && places[begin - 1].time >= time - span)
      --begin;
    return places.slice(begin, end).map((place) => place.truth);
  }

  async stack(line, event) {
    return this.connection.ask("stack", {line, event});
  }

  branch(line, time, interventions) {
    return this.connection.ask("branch", {line, time, interventions});
  }

  journal(line) {
    return this.connection.ask("journal", {line});
  }

  compare(line, other) {
    return this.connection.ask("compare", {line, with: other});
  }

  pause(on) {
    return this.connection.ask("pause", {on});
  }

  pace(value) {
    return this.connection.ask("speed", {value});
  }
}
