// SPDX-License-Identifier: BSD-3-Clause
// One field over time: its values in view, and its curve.

class PlotSeries {
  /** wanted: {robot, poster, field}. */
  constructor(wanted, title) {
    this.wanted = wanted;
    this.title = title;
    this.t = [];
    this.v = [];
    this.asked = 0;
    this.note = "";
  }

  async load(source, line, from, to, points) {
    const asked = ++this.asked;
    try {
      const {t, v} = await source.plot(line, this.wanted, Math.max(0, Math.floor(from)), Math.ceil(to), points);
      if (asked !== this.asked) return false;
      Object.assign(this, {t, v, note: t.length ? "" : "no values here"});
    } catch (error) {
      this.note = error.message;
    }
    return true;
  }

  /** The value that was valid at a time: the last one not later; null if there is none. */
  at(time) {
    const next = firstWhere(this.t.length, (i) => this.t[i] > time);
    return next > 0 ? this.v[next - 1] : null;
  }

  /** Least and greatest value in view, with those just outside; null if there are none. */
  range(from, to) {
    const begin = Math.max(0, firstWhere(this.t.length, (i) => this.t[i] >= from) - 1);
    let least = Infinity,
      greatest = -Infinity;
    for (let i = begin; i < this.t.length && (i === begin || this.t[i - 1] <= to); ++i) {
      if (typeof this.v[i] !== "number") continue;
      least = Math.min(least, this.v[i]);
      greatest = Math.max(greatest, this.v[i]);
    }
    return least > greatest ? null : {begin, least, greatest};
  }

  draw(pen, axis, height, colour) {
    const range = this.range(axis.from, axis.to);
    if (!range) return;
    const {least, greatest} = range,
      room = (greatest - least) * 0.08 || Math.max(1e-9, Math.abs(greatest) * 0.1, 0.1);
    const y = (value) => height - 3 - ((value - least + room) / (greatest - least + 2 * room)) * (height - 6);
    this.drawScale(pen, axis, y, least, greatest);
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = 1.5;
    pen.lineJoin = "round";
    pen.beginPath();
    const dots = this.drawCurve(pen, axis, y, range.begin);
    pen.stroke();
    // Few values are told apart.
    if (dots.length < axis.width / 12) for (const [x, v] of dots) pen.fillRect(x - 2, v - 2, 4, 4);
  }

  /** Within a pixel from the first value by the least and the greatest to the last, so that no peak is lost. */
  drawCurve(pen, axis, y, begin) {
    let column = null,
      drawing = false;
    const dots = [];
    const flush = () => {
      if (!column) return;
      if (drawing) pen.lineTo(column.x, column.first);
      else pen.moveTo(column.x, column.first);
      drawing = true;
      if (column.low !== column.high) (pen.lineTo(column.x, column.low), pen.lineTo(column.x, column.high));
      pen.lineTo(column.x, column.last);
      column = null;
    };
    for (let i = begin; i < this.t.length && (i === begin || this.t[i - 1] <= axis.to); ++i) {
      if (typeof this.v[i] !== "number") {
        flush();
        drawing = false;
        continue;
      }
      const x = axis.x(this.t[i]),
        v = y(this.v[i]);
      if (dots.length < axis.width / 12) dots.push([x, v]);
      if (column && x - column.x < 1)
        Object.assign(column, {low: Math.min(column.low, v), high: Math.max(column.high, v), last: v});
      else (flush(), (column = {x, first: v, low: v, high: v, last: v}));
    }
    flush();
    return dots;
  }

  drawScale(pen, axis, y, least, greatest) {
    const step = roundStep((greatest - least) / 2.5 || 1),
      lines = [];
    for (let value = Math.ceil(least / step) * step; value <= greatest + 1e-12 && lines.length < 6; value += step)
      lines.push(value);
    pen.strokeStyle = theme.colours.grid;
    pen.fillStyle = theme.colours.dim;
    pen.font = "10px system-ui, sans-serif";
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.lineWidth = 1;
    for (const value of lines.length ? lines : [least]) {
      const v = Math.round(y(value)) + 0.5;
      pen.beginPath();
      (pen.moveTo(axis.left, v), pen.lineTo(axis.left + axis.width, v));
      pen.stroke();
      haloText(pen, String(Number(value.toPrecision(6))), axis.left + 3, v);
      pen.fillStyle = theme.colours.dim;
    }
  }
}
