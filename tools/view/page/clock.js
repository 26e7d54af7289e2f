// SPDX-License-Identifier: BSD-3-Clause
// The cursor in time: seeking, stepping, playing. Questions to the source are put one at a time; while one is under
// way, the latest wish waits, and a wish for steps adds to one that waits.

class Clock {
  constructor(session, report) {
    this.session = session;
    this.report = report; // told errors, in a line
    this.playing = false;
    this.live = false; // the cursor is where the run is
    this.speed = 1;
    this.period = 10 * MILLISECOND;
    this.wish = null;
    this.busy = false;
    this.listeners = [];
  }

  get end() {
    return this.session.end;
  }

  changed() {
    for (const listener of this.listeners) listener();
  }

  seek(time) {
    this.setLive(false);
    return this.want({time: Math.max(0, Math.min(Math.round(time), this.end))});
  }

  step(count, task = null) {
    this.pause();
    this.setLive(false);
    if (this.wish && this.wish.task === task && this.wish.count) this.wish.count += count;
    else return this.want({count, task});
  }

  stepPeriod(count, period = this.period) {
    this.pause();
    const now = this.wish?.time ?? this.session.time;
    // To the next multiple of the period, so that steps meet the same instants from wherever they begin.
    return this.seek(
      count > 0 ? (Math.floor(now / period) + count) * period : (Math.ceil(now / period) + count) * period
    );
  }

  /** To the instant just behind an event. */
  async goTo(event) {
    this.pause();
    await this.seek(event.time);
    const {frame} = this.session;
    if (frame && frame.time === event.time && frame.events !== event.number)
      await this.step(event.number - frame.events);
  }

  want(wish) {
    this.wish = wish;
    if (!this.busy) this.done = this.serve();
    return this.done;
  }

  async serve() {
    this.busy = true;
    const {session} = this;
    while (this.wish) {
      const wish = this.wish,
        line = session.line;
      this.wish = null;
      try {
        const frame =
          wish.time !== undefined
            ? await session.source.frame(line, wish.time)
            : await session.source.step(line, wish.count, wish.task, session.frame);
        if (line === session.line) this.arrive(frame);
        if (session.compared) await this.followCompared(frame.time);
      } catch (error) {
        this.pause();
        this.report(error.message);
      }
    }
    this.busy = false;
  }

  arrive(frame) {
    this.session.show(frame);
    if (frame.event !== undefined && frame.event) this.session.changed("stepped");
  }

  /** The line beside this one is shown at the same time, as far as it goes. */
  async followCompared(time) {
    const {compared, source} = this.session;
    const {parent, to} = source.status.lines.find((one) => one.line === compared.line) ?? {to: 0, parent: null};
    compared.frame = await source.frame(compared.line, parent === null ? Math.min(time, to) : time);
    this.session.changed("compare");
  }

  play() {
    if (this.playing) return;
    if (!this.live && this.session.time >= this.end) this.seek(0);
    this.playing = true;
    this.last = performance.now();
    this.position = this.session.time >= this.end ? 0 : this.session.time;
    requestAnimationFrame((now) => this.tick(now));
    this.changed();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.changed();
  }

  /** While the cursor follows the run, the first pause leaves it where it is. */
  toggle() {
    if (this.playing) this.pause();
    else if (this.live) this.setLive(false);
    else this.play();
  }

  tick(now) {
    if (!this.playing) return;
    // Before the next tick is asked for, so that each picture shows the result of the tick before it: else every other
    // one would.
    askPicture();
    const passed = Math.min(now - this.last, 250) * MILLISECOND;
    this.last = now;
    // A seek by hand, or a slow source, moves the position from which playing goes on.
    if (!this.busy && Math.abs(this.session.time - this.position) > 1) this.position = this.session.time;
    if (!this.busy) {
      this.position = Math.min(this.position + passed * this.speed, this.end);
      this.want({time: Math.round(this.position)});
      if (this.position >= this.end && this.session.source.status.over) this.pause();
    }
    requestAnimationFrame((next) => this.tick(next));
  }

  setSpeed(speed) {
    this.speed = Math.max(0.001, Math.min(1000, speed));
    this.changed();
  }

  /** Follows the run as it goes, if the source has one that goes; of one that is over, shows the end. */
  async followRun() {
    if (this.session.source.kind !== "live") return;
    if (!this.session.source.status.over) return this.setLive(true);
    if (this.session.line !== 0) await this.setLine(0);
    await this.seek(this.end);
  }

  setLive(live) {
    if (live === this.live) return;
    this.live = live;
    if (live) {
      this.pause();
      this.session.line = 0;
      this.session.changed("line");
    }
    this.changed();
  }

  toggleLive() {
    return this.live ? this.setLive(false) : this.followRun();
  }

  async setLine(line) {
    this.setLive(false);
    this.session.line = line;
    this.session.changed("run");
    this.session.changed("line");
    await this.seek(Math.min(this.session.time, this.end));
  }
}
