// SPDX-License-Identifier: BSD-3-Clause
// The axis of virtual time that the timeline and the plots share: from hours to nanoseconds.

const LEAST_SPAN = 40; // nanoseconds in the whole width

class TimeAxis {
  constructor(session) {
    this.session = session;
    this.from = 0;
    this.to = 1;
    this.left = 160; // pixels of labels before it
    this.width = 600;
    this.listeners = [];
    this.whole = true; // the whole run is shown, however far it comes
  }

  get end() {
    // A schedule without waits may be over after a few nanoseconds, one for each event.
    return Math.max(this.session.end, this.session.source.finding ? LEAST_SPAN : MILLISECOND);
  }

  get span() {
    return this.to - this.from;
  }

  x(time) {
    return this.left + ((time - this.from) / this.span) * this.width;
  }

  time(x) {
    return this.from + ((x - this.left) / this.width) * this.span;
  }

  set(from, to) {
    let span = Math.max(LEAST_SPAN, Math.min(to - from, this.end * 1.02));
    from = Math.max(-0.01 * span, Math.min(from, this.end * 1.01 - span));
    if (this.end * 1.01 < span) from = -0.005 * span;
    this.from = from;
    this.to = from + span;
    this.whole = span >= this.end;
    for (const listener of this.listeners) listener();
  }

  showAll() {
    this.set(0, this.end * 1.005);
    this.whole = true;
  }

  zoom(factor, x) {
    const about = this.time(x);
    this.set(about - (about - this.from) / factor, about + (this.to - about) / factor);
  }

  pan(pixels) {
    const shift = (-pixels / this.width) * this.span;
    this.set(this.from + shift, this.to + shift);
  }

  /**
   * Brings an instant into view: at its edge the view goes on by most of its width, so that it stands still for a
   * while.
   */
  reveal(time) {
    if (time >= this.from && time <= this.to - 0.04 * this.span) return;
    const from = time - (time < this.from ? 0.7 : 0.12) * this.span;
    this.set(from, from + this.span);
  }

  /** Instants for lines and texts: round ones, with enough room for a text between two. */
  ticks() {
    const least = (this.span * 95) / Math.max(this.width, 95);
    const step =
      least >= 60 * SECOND
        ? ([60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 43200, 86400]
            .map((s) => s * SECOND)
            .find((s) => s >= least) ?? least)
        : least >= 10 * SECOND
          ? [10, 15, 20, 30, 60].map((s) => s * SECOND).find((s) => s >= least)
          : Math.max(1, roundStep(least));
    const found = [];
    for (let time = Math.ceil(Math.max(0, this.from) / step) * step; time <= this.to; time += step) found.push(time);
    return {step, times: found};
  }

  /** A tick's text: the part of a second below the millisecond is told relative to the last whole one. */
  tickText(time, step) {
    if (step >= 60 * SECOND) return clockText(time);
    const digits = Math.max(0, Math.min(9, Math.ceil(9 - Math.log10(step) - 1e-9)));
    return `${(time / SECOND).toFixed(digits)}`;
  }

  /** Ruler and lines over the height of a canvas; the texts are in its first 20 pixels. */
  draw(pen, height, texts = true) {
    const {step, times} = this.ticks();
    pen.strokeStyle = theme.colours.grid;
    pen.lineWidth = 1;
    pen.beginPath();
    for (const time of times) {
      const x = Math.round(this.x(time)) + 0.5;
      (pen.moveTo(x, texts ? 16 : 0), pen.lineTo(x, height));
    }
    pen.stroke();
    if (!texts) return;
    pen.fillStyle = theme.colours.dim;
    pen.font = "11px system-ui, sans-serif";
    pen.textBaseline = "middle";
    pen.textAlign = "left";
    for (const time of times)
      if (this.x(time) < this.left + this.width - 24)
        pen.fillText(this.tickText(time, step), Math.round(this.x(time)) + 3, 10);
  }
}

/** Puts the line of the present instant to a pixel of the axis, or away. */
function placeCursor(line, axis, x) {
  line.hidden = x < axis.left - 1 || x > axis.left + axis.width + 1;
  line.style.transform = `translateX(${x.toFixed(1)}px)`;
}
