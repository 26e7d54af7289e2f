// SPDX-License-Identifier: BSD-3-Clause
// The plan: floor, obstacles and robots at the cursor of a line of time.

const FEW_ROBOTS = 12; // of more, the measurements and intentions of one are shown

class PlanView {
  /**
   * frame_of: the frame to show, which is another line's beside the first one. camera: shared by plans side by side.
   */
  constructor(canvas, session, camera, frameOf, line) {
    this.session = session;
    this.camera = camera;
    this.frameOf = frameOf;
    this.line = line;
    this.floor = new PlanFloor();
    this.measure = null; // {from: {x, y}, to: {x, y}}
    this.title = "";
    this.surface = new Surface(canvas, (pen) => this.paint(pen));
    this.surface.resized = () => this.resize();
    this.resize();
  }

  resize() {
    const {camera, surface} = this,
      first = camera.width === 0;
    if (surface.width === 0) return;
    camera.width = surface.width;
    camera.height = surface.height;
    if (first || camera.fitted) this.fit();
    camera.update();
  }

  /** Shows the whole floor, also after the next changes of size, until the camera is moved. */
  fit() {
    this.camera.fit(this.bounds());
    this.camera.fitted = true;
    this.surface.invalidate();
  }

  bounds() {
    const [left, bottom, right, top] = this.session.header.bounds ?? [0, 0, 10, 10];
    return right > left && top > bottom ? [left, bottom, right, top] : [left - 5, bottom - 5, left + 5, bottom + 5];
  }

  paint(pen) {
    const {session, camera} = this,
      {header, layers} = session,
      ratio = this.surface.ratio,
      frame = this.frameOf();
    if (!frame) return;
    if (session.following && frame.robots[session.robot]) {
      [camera.x, camera.y] = frame.robots[session.robot].truth;
      camera.fitted = false;
    }
    camera.update();
    this.floor.set(frame.obstacles ?? header.obstacles);
    this.floor.drawStill(pen, camera, ratio, this.bounds(), layers);
    const seen = robotsInView(camera, header, frame),
      detailed = this.detailed(seen);
    this.drawBelow(pen, frame, detailed);
    if (camera.oblique) {
      drawStalks(pen, camera, frame, seen);
      const flat = seen.filter((index) => reachOf(header.robots[index]) * camera.scale < PLAIN);
      drawPrisms(pen, camera, [...this.floor.prisms(layers), ...robotPrisms(camera, header, frame, seen)]);
      drawRobots(pen, camera, header, frame, flat);
      for (const index of seen.filter((index) => detailed.includes(index))) {
        const [x, y, heading, z = 0] = frame.robots[index].truth;
        drawHeading(
          pen,
          camera,
          [x, y, heading, z + header.robots[index].high],
          reachOf(header.robots[index]) * 0.72,
          theme.colours.floor
        );
      }
    } else drawRobots(pen, camera, header, frame, seen);
    this.drawAbove(pen, frame, detailed);
    drawNames(pen, camera, header, frame, seen, session.robot, layers.names && camera.scale * 0.3 > 3);
    drawScaleBar(pen, camera);
    if (this.measure) drawMeasure(pen, camera, this.measure);
    if (this.title) this.drawTitle(pen);
  }

  /** The robots whose measurements and intentions are drawn: all if they are few, else the one that is selected. */
  detailed(seen) {
    const {robot, header} = this.session;
    return header.robots.length <= FEW_ROBOTS ? seen : seen.filter((index) => index === robot);
  }

  drawBelow(pen, frame, indices) {
    const {session, camera} = this,
      {layers, header} = session;
    for (const index of indices) {
      const state = frame.robots[index],
        robot = header.robots[index];
      if (layers.laser) drawScans(pen, camera, robot, state, index);
      if (layers.sonar) drawSonars(pen, camera, robot, state);
      // Maps of several robots hide each other.
      if (layers.segments && index === session.robot) drawSegments(pen, camera, state);
      if (layers.trail)
        drawTrail(pen, camera, session.source.trail(this.line(), index, frame.time, session.trail), robotColour(index));
      if (layers.route) drawRoute(pen, camera, state);
      if (layers.goals && index === session.robot && !camera.oblique)
        drawGoals(pen, camera, robot, state, layers.names);
    }
  }

  drawAbove(pen, frame, indices) {
    const {camera, session} = this,
      {layers, header} = session,
      colours = theme.colours;
    for (const index of indices) {
      const state = frame.robots[index],
        robot = header.robots[index];
      if (layers.goals && index === session.robot && camera.oblique) drawGoals(pen, camera, robot, state, layers.names);
      if (layers.covariance && state.estimate && state.covariance)
        drawCovariance(pen, camera, state.estimate, state.covariance);
      if (layers.odometry) drawGhost(pen, camera, robot, state.odometry, colours.odometry, [2, 3]);
      if (layers.estimate) drawGhost(pen, camera, robot, state.estimate, colours.estimate, [5, 3]);
    }
  }

  drawTitle(pen) {
    pen.font = "600 13px system-ui, sans-serif";
    pen.textAlign = "left";
    pen.textBaseline = "top";
    haloText(pen, this.title, 12, 48);
  }

  /** The index of the robot at a pixel, or -1. */
  robotAt(u, v) {
    const {camera} = this,
      frame = this.frameOf();
    let best = -1,
      nearest = Infinity;
    frame?.robots.forEach((robot, index) => {
      if (!robot) return;
      const distance = Math.hypot(
        camera.across(robot.truth[0], robot.truth[1]) - u,
        camera.down(robot.truth[0], robot.truth[1], robot.truth[3] ?? 0) - v
      );
      const reach = Math.max(10, reachOf(this.session.header.robots[index]) * camera.scale + 3);
      if (distance < reach && distance < nearest) [best, nearest] = [index, distance];
    });
    return best;
  }

  /** Describes the thing under the pointer. */
  textAt(u, v) {
    const {x, y} = this.camera.place(u, v),
      robot = this.robotAt(u, v);
    const obstacle = robot < 0 && this.floor.obstacles ? this.floor.at(x, y, this.session.layers) : null;
    const name =
      robot >= 0
        ? this.session.header.robots[robot].name
        : obstacle
          ? `${obstacle.name}, ${metres(obstacle.high)} high${obstacle.known === false ? ", not on the map" : ""}`
          : "";
    return `${placeText(x, y)}${name ? ` · ${name}` : ""}`;
  }
}

function drawScaleBar(pen, camera) {
  if (camera.oblique) return; // lengths differ by direction
  const length = roundStep(60 / camera.scale),
    pixels = length * camera.scale,
    v = camera.height - 14,
    u = 14;
  pen.beginPath();
  (pen.moveTo(u, v - 5), pen.lineTo(u, v), pen.lineTo(u + pixels, v), pen.lineTo(u + pixels, v - 5));
  pen.strokeStyle = theme.colours.text;
  pen.lineWidth = 1.5;
  pen.stroke();
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  haloText(pen, length >= 1 ? `${length} m` : `${rounded(length * 100)} cm`, u + pixels / 2, v - 3);
}

/** A line with its length and direction. */
function drawMeasure(pen, camera, {from, to}) {
  const u1 = camera.across(from.x, from.y),
    v1 = camera.down(from.x, from.y),
    u2 = camera.across(to.x, to.y),
    v2 = camera.down(to.x, to.y);
  pen.strokeStyle = pen.fillStyle = theme.colours.text;
  pen.lineWidth = 1.5;
  pen.beginPath();
  (pen.moveTo(u1, v1), pen.lineTo(u2, v2));
  pen.stroke();
  for (const [u, v] of [
    [u1, v1],
    [u2, v2]
  ])
    pen.fillRect(u - 2.5, v - 2.5, 5, 5);
  pen.font = "600 12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  haloText(pen, measureText({from, to}), (u1 + u2) / 2, (v1 + v2) / 2 - 8);
}

const measureText = ({from, to}) =>
  `${Math.hypot(to.x - from.x, to.y - from.y).toFixed(3)} m, ${degrees(Math.atan2(to.y - from.y, to.x - from.x))}`;
