// SPDX-License-Identifier: BSD-3-Clause
// The controls of time: play, steps, speed, the typed instant, and the slider over the whole run.

const SPEEDS = [0.001, 0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];

class Transport {
  constructor(session, clock, axis) {
    Object.assign(this, {session, clock, axis});
    const on = (id, action) => byId(id).addEventListener("click", action);
    on("to-begin", () => clock.seek(0));
    on("to-end", () => clock.seek(clock.end));
    on("back-event", () => clock.step(-1));
    on("next-event", () => clock.step(1));
    on("back-period", () => clock.stepPeriod(-1));
    on("next-period", () => clock.stepPeriod(1));
    on("play", () => clock.toggle());
    on("live", () => clock.toggleLive());
    byId("speed").append(
      ...SPEEDS.map((speed) => element("option", {value: speed, selected: speed === 1}, `${speed}×`))
    );
    byId("speed").addEventListener("change", (event) => clock.setSpeed(Number(event.target.value)));
    byId("period").addEventListener("change", (event) => (clock.period = Number(event.target.value)));
    byId("time").addEventListener("change", (event) => this.typed(event.target));
    byId("time").addEventListener("keydown", (event) => {
      if (event.key === "Escape") event.target.blur();
    });
    this.slider = byId("slider");
    this.slider.addEventListener("input", () => clock.seek(Number(this.slider.value)));
    this.overview = new Surface(byId("overview"), (pen, width, height) => this.paintOverview(pen, width, height));
    clock.listeners.push(() => this.update());
    session.on("time run", () => this.update());
    session.on("theme run log", () => this.overview.invalidate());
    axis.listeners.push(() => this.overview.invalidate());
    this.update();
  }

  typed(field) {
    const time = parseTime(field.value, this.session.time);
    field.setAttribute("aria-invalid", String(time === null));
    if (time !== null) {
      this.clock.pause();
      this.clock.seek(time);
      field.blur();
    }
  }

  update() {
    const {clock, session} = this,
      time = session.time,
      end = Math.max(1, clock.end);
    if (document.activeElement !== byId("time")) byId("time").value = instantText(time).replace(" s", "");
    if (Number(this.slider.max) !== end) this.slider.max = end;
    this.slider.value = time;
    this.slider.setAttribute("aria-valuetext", shortInstantText(time));
    setText(byId("of"), `of ${shortInstantText(clock.end)} · event ${countText(session.frame?.events ?? 0)}`);
    const play = byId("play");
    const moves = clock.playing || clock.live;
    play.classList.toggle("playing", moves);
    play.setAttribute("aria-label", moves ? "Pause" : "Play");
    play.title = `${moves ? "Pause" : "Play"} (space)`;
    byId("live").hidden = session.source.kind !== "live";
    byId("live").setAttribute("aria-pressed", String(clock.live));
    const speed = byId("speed");
    if (Number(speed.value) !== clock.speed)
      speed.value = String(
        SPEEDS.reduce((best, one) => (Math.abs(one - clock.speed) < Math.abs(best - clock.speed) ? one : best))
      );
  }

  /** Behind the slider: events a second of all tasks, deadlines missed, collisions, lines of the log, the timeline's view. */
  paintOverview(pen, width, height) {
    const colours = theme.colours,
      end = Math.max(1, this.clock.end),
      margin = 8,
      scale = (width - 2 * margin) / end,
      x = (time) => margin + time * scale;
    pen.clearRect(0, 0, width, height);
    pen.fillStyle = colours.band;
    pen.fillRect(margin, 4, width - 2 * margin, height - 8);
    const counts = this.counts?.();
    if (counts) this.paintCounts(pen, counts, x, height);
    pen.fillStyle = colours.text;
    for (const [time] of counts?.collisions ?? []) pen.fillRect(x(time) - 1, 2, 2, height - 4);
    for (const [time, , , , bad] of this.session.source.log) {
      pen.fillStyle = bad ? colours.late : colours.goal;
      pen.fillRect(x(time) - 1, bad ? height - 12 : height - 9, bad ? 3 : 2, bad ? 8 : 5);
    }
    pen.strokeStyle = colours.text;
    pen.lineWidth = 1;
    const from = Math.max(0, this.axis.from),
      to = Math.min(end, this.axis.to);
    if (to - from < 0.995 * end)
      pen.strokeRect(Math.round(x(from)) - 0.5, 3.5, Math.max(2, Math.round(x(to) - x(from))) + 1, height - 7);
  }

  paintCounts(pen, counts, x, height) {
    const length = Math.max(0, ...counts.events.map((row) => row.length)),
      sums = new Float64Array(length);
    for (const row of counts.events) row.forEach((count, i) => (sums[i] += count));
    const greatest = Math.max(1, ...sums);
    pen.fillStyle = theme.colours.running;
    pen.globalAlpha = 0.35;
    sums.forEach((sum, i) => {
      const size = ((height - 10) * sum) / greatest,
        left = x(counts.from + i * counts.period),
        right = Math.min(x(counts.from + (i + 1) * counts.period), x(this.clock.end));
      if (right > left) pen.fillRect(left, height - 5 - size, right - left + 0.3, size);
    });
    pen.globalAlpha = 1;
    pen.fillStyle = theme.colours.late;
    for (const row of counts.missed ?? [])
      row.forEach((count, i) => count > 0 && pen.fillRect(x(counts.from + i * counts.period) - 1, 4, 3, 7));
  }
}
