// SPDX-License-Identifier: BSD-3-Clause
// From metres to pixels and back: an orthographic view from above, or oblique, with heights.

class Camera {
  constructor() {
    this.x = this.y = 0; // the place on the floor that is in the middle
    this.scale = 20; // pixels a metre
    this.turn = 0; // of the view about the vertical
    this.tilt = Math.PI / 2; // of the line of sight above the floor: a right angle is the view from above
    this.width = this.height = 0;
    this.update();
  }

  get oblique() {
    return this.tilt < Math.PI / 2;
  }

  /** The matrix of places on the floor, and the pixels that a metre of height takes. To be called after each change. */
  update() {
    const cos = Math.cos(this.turn),
      sin = Math.sin(this.turn),
      squeeze = Math.sin(this.tilt),
      s = this.scale;
    Object.assign(this, {
      a: s * cos,
      b: -s * squeeze * sin,
      c: -s * sin,
      d: -s * squeeze * cos,
      up: s * Math.cos(this.tilt)
    });
    this.e = this.width / 2 - this.a * this.x - this.c * this.y;
    this.f = this.height / 2 - this.b * this.x - this.d * this.y;
    return this;
  }

  across(x, y) {
    return this.a * x + this.c * y + this.e;
  }

  down(x, y, z = 0) {
    return this.b * x + this.d * y + this.f - this.up * z;
  }

  /** Nearness to the eye: nearer things are drawn later. */
  nearness(x, y) {
    return this.b * x + this.d * y;
  }

  place(across, down) {
    const determinant = this.a * this.d - this.b * this.c,
      u = across - this.e,
      v = down - this.f;
    return {x: (this.d * u - this.c * v) / determinant, y: (this.a * v - this.b * u) / determinant};
  }

  /** Lets the pen draw in metres, `height` above the floor. Lines are drawn with a width of 1 / scale. */
  apply(pen, ratio, height = 0) {
    pen.setTransform(
      ratio * this.a,
      ratio * this.b,
      ratio * this.c,
      ratio * this.d,
      ratio * this.e,
      ratio * (this.f - this.up * height)
    );
  }

  pan(across, down) {
    const before = this.place(0, 0),
      after = this.place(across, down);
    this.x -= after.x - before.x;
    this.y -= after.y - before.y;
    this.update();
  }

  /** Zooms about a pixel, whose place on the floor stays there. */
  zoom(factor, across, down) {
    const before = this.place(across, down);
    this.scale = Math.max(0.05, Math.min(20000, this.scale * factor));
    this.update();
    const after = this.place(across, down);
    this.x += before.x - after.x;
    this.y += before.y - after.y;
    this.update();
  }

  /** Shows the whole of the bounds. */
  fit([left, bottom, right, top], margin = 24) {
    this.x = (left + right) / 2;
    this.y = (bottom + top) / 2;
    this.scale = 1;
    this.update();
    const corners = [
      [left, bottom],
      [right, bottom],
      [left, top],
      [right, top]
    ];
    const wide = extent(corners.map(([x, y]) => this.across(x, y))),
      high = extent(corners.map(([x, y]) => this.down(x, y)));
    this.scale = Math.max(
      0.05,
      Math.min((this.width - 2 * margin) / Math.max(wide, 1e-3), (this.height - 2 * margin) / Math.max(high, 1e-3))
    );
    this.update();
  }

  /** The part of the floor in view, as bounds. */
  bounds() {
    const corners = [
      [0, 0],
      [this.width, 0],
      [0, this.height],
      [this.width, this.height]
    ].map(([u, v]) => this.place(u, v));
    const xs = corners.map((corner) => corner.x),
      ys = corners.map((corner) => corner.y);
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  }
}

const extent = (values) => Math.max(...values) - Math.min(...values);
