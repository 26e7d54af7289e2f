// SPDX-License-Identifier: BSD-3-Clause
// A canvas that fills its element, sharp on any screen, and painted at most once for each picture of the screen.

const surfaces = new Set();
let pictureAsked = false;

/** For tests and the figure in the corner of the plan: pictures painted, and the time that the last ones took. */
const pictures = {count: 0, cost: 0};

function askPicture() {
  if (pictureAsked) return;
  pictureAsked = true;
  requestAnimationFrame(paintSurfaces);
}

function paintSurfaces() {
  pictureAsked = false;
  const begin = performance.now();
  for (const surface of surfaces) {
    if (!surface.stale || surface.width === 0 || surface.height === 0) continue;
    surface.stale = false;
    surface.pen.setTransform(surface.ratio, 0, 0, surface.ratio, 0, 0);
    surface.paint(surface.pen, surface.width, surface.height);
  }
  ++pictures.count;
  pictures.cost += (performance.now() - begin - pictures.cost) / 8;
}

class Surface {
  /** paint(pen, width, height): lengths in CSS pixels. */
  constructor(canvas, paint) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
    this.paint = paint;
    this.width = this.height = 0;
    this.ratio = 1;
    this.stale = true;
    this.resized = () => {};
    surfaces.add(this);
    this.observer = new ResizeObserver(() => this.fit());
    this.observer.observe(canvas.parentElement);
    this.fit();
  }

  fit() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const width = Math.floor(box.width),
      height = Math.floor(box.height);
    if (width === this.width && height === this.height && ratio === this.ratio) return;
    Object.assign(this, {width, height, ratio});
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    this.resized();
    this.invalidate();
  }

  invalidate() {
    this.stale = true;
    askPicture();
  }

  /** A pointer's place on the canvas. */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  }

  close() {
    this.observer.disconnect();
    surfaces.delete(this);
  }
}
