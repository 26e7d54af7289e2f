// SPDX-License-Identifier: BSD-3-Clause
// The plan's floor, with a grid, walls and furniture; in the oblique view they are prisms.

const WALL_HEIGHT = 2; // metres: higher things hide the room behind them, and are drawn as walls

const isWall = (obstacle) => obstacle.high >= WALL_HEIGHT;

/** The corners of a shape with an outline or a radius; of a body at a pose, if one is given. */
function cornersOf(shape, pose = null) {
  const sides = 20;
  const corners =
    shape.outline ??
    Array.from({length: sides}, (_, i) => [
      (shape.x ?? 0) + (shape.radius ?? 0.2) * Math.cos((2 * Math.PI * i) / sides),
      (shape.y ?? 0) + (shape.radius ?? 0.2) * Math.sin((2 * Math.PI * i) / sides)
    ]);
  if (!pose) return corners;
  const cos = Math.cos(pose[2]),
    sin = Math.sin(pose[2]);
  return corners.map(([x, y]) => [pose[0] + x * cos - y * sin, pose[1] + x * sin + y * cos]);
}

function tracePolygon(path, corners) {
  corners.forEach(([x, y], i) => (i === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  path.closePath();
}

class PlanFloor {
  constructor() {
    this.obstacles = null;
    this.picture = document.createElement("canvas"); // of the static floor, for a camera at rest
    this.drawn = "";
  }

  /** The floor from the picture of the last time, if it would be the same. */
  drawStill(pen, camera, ratio, bounds, layers) {
    const wanted = [
      camera.a,
      camera.b,
      camera.c,
      camera.d,
      camera.e,
      camera.f,
      camera.width,
      camera.height,
      ratio,
      layers.grid,
      layers.furniture,
      layers.unknown,
      theme.dark
    ].join();
    if (wanted !== this.drawn) {
      this.drawn = wanted;
      this.picture.width = Math.round(camera.width * ratio);
      this.picture.height = Math.round(camera.height * ratio);
      const own = this.picture.getContext("2d");
      own.setTransform(ratio, 0, 0, ratio, 0, 0);
      this.drawGround(own, camera, ratio, bounds, layers);
      if (!camera.oblique) this.draw(own, camera, ratio, layers);
    }
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.drawImage(this.picture, 0, 0);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /** Called with each frame's list; paths are made anew only if it is another one. */
  set(obstacles) {
    if (obstacles === this.obstacles) return;
    this.obstacles = obstacles;
    this.drawn = "";
    this.shapes = obstacles.map((obstacle) => ({obstacle, corners: cornersOf(obstacle)}));
    const pathOf = (wanted) => {
      const path = new Path2D();
      for (const {obstacle, corners} of this.shapes) if (wanted(obstacle)) tracePolygon(path, corners);
      return path;
    };
    this.walls = pathOf((obstacle) => obstacle.known !== false && isWall(obstacle));
    this.furniture = pathOf((obstacle) => obstacle.known !== false && !isWall(obstacle));
    this.unknown = pathOf((obstacle) => obstacle.known === false);
  }

  drawGround(pen, camera, ratio, bounds, layers) {
    const colours = theme.colours,
      [left, bottom, right, top] = bounds;
    pen.fillStyle = colours.outside;
    pen.fillRect(0, 0, camera.width, camera.height);
    camera.apply(pen, ratio);
    pen.fillStyle = colours.floor;
    pen.fillRect(left, bottom, right - left, top - bottom);
    if (layers.grid) drawGrid(pen, camera, bounds);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /** The view from above. Furniture and walls are below everything drawn later: they hide nothing there. */
  draw(pen, camera, ratio, layers) {
    const colours = theme.colours;
    camera.apply(pen, ratio);
    pen.lineWidth = 1 / camera.scale;
    if (layers.furniture) {
      pen.fillStyle = colours.furniture;
      pen.strokeStyle = colours.furnitureLine;
      pen.fill(this.furniture);
      pen.stroke(this.furniture);
    }
    pen.fillStyle = pen.strokeStyle = colours.wall;
    pen.fill(this.walls);
    pen.stroke(this.walls); // thin walls stay visible from afar
    if (layers.unknown) {
      const pattern = hatch(pen, "rising", colours.unknownLine, colours.unknown);
      // The pattern's lines have the same distance at any scale.
      pattern.setTransform(new DOMMatrix().scale(1 / camera.scale, -1 / camera.scale));
      pen.fillStyle = pattern;
      pen.strokeStyle = colours.unknownLine;
      pen.lineWidth = 1.5 / camera.scale;
      pen.fill(this.unknown);
      pen.stroke(this.unknown);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  prisms(layers) {
    const colours = theme.colours;
    return this.shapes
      .filter(({obstacle}) => (obstacle.known === false ? layers.unknown : isWall(obstacle) || layers.furniture))
      .map(({obstacle, corners}) => ({
        corners,
        low: obstacle.low,
        high: obstacle.high,
        alpha: isWall(obstacle) ? 0.42 : 0.92,
        fill: obstacle.known === false ? colours.unknown : isWall(obstacle) ? colours.wall : colours.furniture,
        line: obstacle.known === false ? colours.unknownLine : isWall(obstacle) ? colours.wall : colours.furnitureLine
      }));
  }

  /** The obstacle at a place on the floor, the last one drawn first. */
  at(x, y, layers) {
    for (let i = this.shapes.length - 1; i >= 0; --i) {
      const {obstacle, corners} = this.shapes[i];
      if ((obstacle.known !== false || layers.unknown) && within(corners, x, y)) return obstacle;
    }
    return null;
  }
}

/** True if a place is in a polygon: an odd number of its sides is to the right of it. */
function within(corners, x, y) {
  let inside = false;
  corners.forEach(([x1, y1], i) => {
    const [x2, y2] = corners[(i + 1) % corners.length];
    if (y1 > y !== y2 > y && x < x1 + ((x2 - x1) * (y - y1)) / (y2 - y1)) inside = !inside;
  });
  return inside;
}

/** The least of 1, 2, 5 times a power of ten that is not below `least`. */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least)),
    part = least / power;
  return power * (part <= 1.0000001 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10);
}

function drawGrid(pen, camera, [left, bottom, right, top]) {
  const step = roundStep(28 / camera.scale),
    view = camera.bounds();
  pen.strokeStyle = theme.colours.grid;
  pen.lineWidth = 1 / camera.scale;
  pen.beginPath();
  for (let x = Math.ceil(Math.max(left, view[0]) / step) * step; x <= Math.min(right, view[2]); x += step)
    (pen.moveTo(x, bottom), pen.lineTo(x, top));
  for (let y = Math.ceil(Math.max(bottom, view[1]) / step) * step; y <= Math.min(top, view[3]); y += step)
    (pen.moveTo(left, y), pen.lineTo(right, y));
  pen.stroke();
}

/** Prisms in the order of their distance; lines in pixels, so the pen is not in metres. */
function drawPrisms(pen, camera, prisms) {
  const distant = prisms.map((prism) => ({
    prism,
    near: Math.max(...prism.corners.map(([x, y]) => camera.nearness(x, y)))
  }));
  distant.sort((one, other) => one.near - other.near);
  for (const {prism} of distant) drawPrism(pen, camera, prism);
  pen.globalAlpha = 1;
}

function drawPrism(pen, camera, {corners, low, high, fill, line, alpha}) {
  const points = corners.map(([x, y]) => [camera.across(x, y), camera.down(x, y, low), camera.down(x, y, high)]);
  const area = points.reduce(
    (sum, [u, v], i) => sum + u * points[(i + 1) % points.length][1] - v * points[(i + 1) % points.length][0],
    0
  );
  pen.fillStyle = fill;
  pen.strokeStyle = line;
  pen.lineWidth = 0.75;
  points.forEach(([u1, foot1, head1], i) => {
    const [u2, foot2, head2] = points[(i + 1) % points.length];
    if ((u2 - u1) * Math.sign(area) < 0) {
      // the side faces the eye
      pen.globalAlpha = alpha * 0.75;
      pen.beginPath();
      (pen.moveTo(u1, foot1), pen.lineTo(u2, foot2), pen.lineTo(u2, head2), pen.lineTo(u1, head1), pen.closePath());
      pen.fill();
      pen.stroke();
    }
  });
  pen.globalAlpha = alpha;
  pen.beginPath();
  points.forEach(([u, , head], i) => (i === 0 ? pen.moveTo(u, head) : pen.lineTo(u, head)));
  pen.closePath();
  pen.fill();
  pen.stroke();
}
