// SPDX-License-Identifier: BSD-3-Clause
// Robots on the plan, in as much detail as their size on the screen allows: a thousand of them are a few paths.

const DETAILED = 9; // pixels of a robot's radius above which its shape is drawn
const PLAIN = 2.5; // and below which it is a square

const robotColour = (index) => theme.colours.robots[index % theme.colours.robots.length];

/** The distance of a body's centre from its farthest corner. */
function reachOf(robot) {
  robot.reach ??= robot.outline ? Math.max(...robot.outline.map(([x, y]) => Math.hypot(x, y))) : (robot.radius ?? 0.2);
  return robot.reach;
}

/** Indices of the robots whose bodies are in view. */
function robotsInView(camera, header, frame) {
  const found = [];
  frame.robots.forEach((robot, index) => {
    if (!robot) return;
    const reach = 30 + reachOf(header.robots[index]) * camera.scale;
    const u = camera.across(robot.truth[0], robot.truth[1]),
      v = camera.down(robot.truth[0], robot.truth[1], robot.truth[3] ?? 0);
    if (u > -reach && u < camera.width + reach && v > -reach && v < camera.height + reach) found.push(index);
  });
  return found;
}

function drawRobots(pen, camera, header, frame, seen) {
  const small = new Map(); // by colour: those without detail
  for (const index of seen) {
    const size = reachOf(header.robots[index]) * camera.scale;
    if (size >= DETAILED && seen.length <= 400)
      drawRobot(pen, camera, header.robots[index], frame.robots[index].truth, index);
    else {
      const colour = robotColour(index);
      if (!small.has(colour)) small.set(colour, []);
      small.get(colour).push(index);
    }
  }
  for (const [colour, indices] of small) drawSmallRobots(pen, camera, header, frame, indices, colour);
}

/** Bodies one by one, since a path with hundreds of parts takes longer to fill than as many paths. */
function drawSmallRobots(pen, camera, header, frame, indices, colour) {
  const heads = new Path2D();
  pen.fillStyle = pen.strokeStyle = colour;
  for (const index of indices) {
    const [x, y, heading, z = 0] = frame.robots[index].truth;
    const size = reachOf(header.robots[index]) * camera.scale,
      u = camera.across(x, y),
      v = camera.down(x, y, z);
    if (size <= PLAIN) {
      pen.fillRect(u - 2, v - 2, 4, 4);
      continue;
    }
    pen.beginPath();
    pen.arc(u, v, size, 0, 2 * Math.PI);
    pen.fill();
    const ahead = (1.6 * size) / camera.scale,
      x1 = x + ahead * Math.cos(heading),
      y1 = y + ahead * Math.sin(heading);
    heads.moveTo(u, v);
    heads.lineTo(camera.across(x1, y1), camera.down(x1, y1, z));
  }
  pen.lineWidth = 1.5;
  pen.stroke(heads);
}

/** A body with an arrow for its heading; flat. */
function drawRobot(pen, camera, robot, pose, index) {
  const corners = cornersOf(robot, pose),
    z = pose[3] ?? 0;
  pen.beginPath();
  traceOnScreen(pen, camera, corners, z);
  pen.closePath();
  pen.globalAlpha = 0.9;
  pen.fillStyle = robotColour(index);
  pen.fill();
  pen.globalAlpha = 1;
  pen.strokeStyle = theme.colours.floor;
  pen.lineWidth = 1.5;
  pen.stroke();
  drawHeading(pen, camera, pose, reachOf(robot) * 0.72, theme.colours.floor);
}

/** An arrowhead from the centre of a body to its front. */
function drawHeading(pen, camera, [x, y, heading, z = 0], size, colour) {
  const cos = Math.cos(heading) * size,
    sin = Math.sin(heading) * size;
  pen.beginPath();
  traceOnScreen(
    pen,
    camera,
    [
      [x + cos, y + sin],
      [x - 0.55 * cos - 0.6 * sin, y - 0.55 * sin + 0.6 * cos],
      [x - 0.2 * cos, y - 0.2 * sin],
      [x - 0.55 * cos + 0.6 * sin, y - 0.55 * sin - 0.6 * cos]
    ],
    z
  );
  pen.closePath();
  pen.fillStyle = colour;
  pen.fill();
}

function traceOnScreen(pen, camera, points, z = 0) {
  points.forEach(([x, y], i) =>
    i === 0
      ? pen.moveTo(camera.across(x, y), camera.down(x, y, z))
      : pen.lineTo(camera.across(x, y), camera.down(x, y, z))
  );
}

/** Bodies as prisms, for the oblique view, and a stalk to the floor below flying robots. */
function robotPrisms(camera, header, frame, seen) {
  return seen
    .filter((index) => reachOf(header.robots[index]) * camera.scale >= PLAIN)
    .map((index) => {
      const robot = header.robots[index],
        pose = frame.robots[index].truth,
        z = pose[3] ?? 0;
      return {
        corners: cornersOf(robot, pose),
        low: z + robot.low,
        high: z + Math.max(robot.high, robot.low + 0.05),
        alpha: 1,
        fill: robotColour(index),
        line: theme.colours.floor
      };
    });
}

function drawStalks(pen, camera, frame, seen) {
  pen.beginPath();
  for (const index of seen) {
    const [x, y, , z = 0] = frame.robots[index].truth;
    if (z > 0.01)
      (pen.moveTo(camera.across(x, y), camera.down(x, y)), pen.lineTo(camera.across(x, y), camera.down(x, y, z)));
  }
  pen.strokeStyle = theme.colours.dim;
  pen.lineWidth = 1;
  pen.stroke();
}

/** Names beside robots, as long as there is room for them, and a ring about the robot that is selected. */
function drawNames(pen, camera, header, frame, seen, chosen, names) {
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  for (const index of seen) {
    const [x, y, , z = 0] = frame.robots[index].truth,
      robot = header.robots[index];
    const size = Math.max(4, reachOf(robot) * camera.scale),
      u = camera.across(x, y),
      v = camera.down(x, y, z + (camera.oblique ? robot.high : 0));
    if (index === chosen && header.robots.length > 1) {
      pen.beginPath();
      pen.arc(u, camera.down(x, y, z), size + 5, 0, 2 * Math.PI);
      pen.strokeStyle = theme.colours.select;
      pen.lineWidth = 2;
      pen.stroke();
    }
    if (names && (index === chosen || seen.length <= 60))
      haloText(pen, robot.name, u, v - (camera.oblique ? 6 : size + 6));
  }
}

/** Text that is legible on anything. */
function haloText(pen, text, u, v) {
  pen.lineWidth = 3;
  pen.lineJoin = "round";
  pen.strokeStyle = theme.colours.floor;
  pen.strokeText(text, u, v);
  pen.fillStyle = theme.colours.text;
  pen.fillText(text, u, v);
}
