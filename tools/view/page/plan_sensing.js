// SPDX-License-Identifier: BSD-3-Clause
// Measurements, estimates and intentions of robots on the plan: lasers, sonars, the estimate with its covariance, maps, routes,
// goals.

/** Each laser's scan as a fan, with a dot for each echo: beams that met nothing have none. */
function drawScans(pen, camera, robot, state, index) {
  for (const scan of state.scans ?? []) {
    const mount = robot.lasers[scan.laser],
      pose = scan.pose ?? state.truth;
    if (!mount) continue;
    const cos = Math.cos(pose[2]),
      sin = Math.sin(pose[2]);
    const x = pose[0] + mount.x * cos - mount.y * sin,
      y = pose[1] + mount.x * sin + mount.y * cos;
    const fan = new Path2D(),
      echoes = new Path2D(),
      colour = theme.colours.laser;
    fan.moveTo(camera.across(x, y), camera.down(x, y));
    scan.ranges.forEach((range, beam) => {
      const angle = pose[2] + mount.heading + scan.first + beam * scan.step,
        r = Math.min(range, scan.max);
      const u = camera.across(x + r * Math.cos(angle), y + r * Math.sin(angle)),
        v = camera.down(x + r * Math.cos(angle), y + r * Math.sin(angle));
      fan.lineTo(u, v);
      if (range < scan.max) echoes.rect(u - 1, v - 1, 2, 2);
    });
    fan.closePath();
    pen.fillStyle = colour;
    pen.globalAlpha = 0.13;
    pen.fill(fan);
    pen.globalAlpha = 0.85;
    pen.fill(echoes);
    pen.globalAlpha = 1;
  }
}

/** Sonars' cones up to the nearest echo. */
function drawSonars(pen, camera, robot, state) {
  const [x, y, heading] = state.truth,
    cos = Math.cos(heading),
    sin = Math.sin(heading),
    cones = new Path2D();
  (state.sonars ?? []).forEach((range, i) => {
    const sonar = robot.sonars[i];
    if (!sonar) return;
    const sx = x + sonar.x * cos - sonar.y * sin,
      sy = y + sonar.x * sin + sonar.y * cos,
      r = Math.min(range, sonar.range);
    cones.moveTo(camera.across(sx, sy), camera.down(sx, sy));
    for (let part = -2; part <= 2; ++part) {
      const angle = heading + sonar.heading + (part * sonar.width) / 4;
      cones.lineTo(
        camera.across(sx + r * Math.cos(angle), sy + r * Math.sin(angle)),
        camera.down(sx + r * Math.cos(angle), sy + r * Math.sin(angle))
      );
    }
    cones.closePath();
  });
  pen.fillStyle = pen.strokeStyle = theme.colours.sonar;
  pen.lineWidth = 1;
  pen.globalAlpha = 0.16;
  pen.fill(cones);
  pen.globalAlpha = 0.7;
  pen.stroke(cones);
  pen.globalAlpha = 1;
}

/** The body's outline where the robot believes to be: dashed. */
function drawGhost(pen, camera, robot, pose, colour, dash) {
  if (!pose) return;
  const z = pose[3] ?? 0;
  pen.beginPath();
  traceOnScreen(pen, camera, cornersOf(robot, pose), z);
  pen.closePath();
  const reach = reachOf(robot) * 1.5;
  pen.moveTo(camera.across(pose[0], pose[1]), camera.down(pose[0], pose[1], z));
  pen.lineTo(
    camera.across(pose[0] + reach * Math.cos(pose[2]), pose[1] + reach * Math.sin(pose[2])),
    camera.down(pose[0] + reach * Math.cos(pose[2]), pose[1] + reach * Math.sin(pose[2]), z)
  );
  pen.setLineDash(dash);
  pen.strokeStyle = colour;
  pen.lineWidth = 2;
  pen.stroke();
  pen.setLineDash([]);
}

/** The ellipse of three standard deviations about the estimate: the axes are the covariance's eigenvectors. */
function drawCovariance(pen, camera, estimate, [xx, xy, yy]) {
  const mean = (xx + yy) / 2,
    spread = Math.hypot((xx - yy) / 2, xy),
    turn = Math.atan2(2 * xy, xx - yy) / 2;
  const long = 3 * Math.sqrt(Math.max(0, mean + spread)),
    short = 3 * Math.sqrt(Math.max(0, mean - spread));
  const points = Array.from({length: 48}, (_, i) => {
    const angle = (2 * Math.PI * i) / 48,
      p = long * Math.cos(angle),
      q = short * Math.sin(angle);
    return [
      estimate[0] + p * Math.cos(turn) - q * Math.sin(turn),
      estimate[1] + p * Math.sin(turn) + q * Math.cos(turn)
    ];
  });
  pen.beginPath();
  traceOnScreen(pen, camera, points);
  pen.closePath();
  pen.fillStyle = pen.strokeStyle = theme.colours.estimate;
  pen.globalAlpha = 0.14;
  pen.fill();
  pen.globalAlpha = 1;
  pen.lineWidth = 1;
  pen.stroke();
}

function drawRoute(pen, camera, state) {
  const route = state.route ?? [];
  if (route.length < 2) return;
  pen.beginPath();
  traceOnScreen(pen, camera, route);
  pen.strokeStyle = theme.colours.route;
  pen.lineWidth = 2.5;
  pen.lineJoin = "round";
  pen.setLineDash([8, 5]);
  pen.stroke();
  pen.setLineDash([]);
}

function drawSegments(pen, camera, state) {
  pen.beginPath();
  for (const [x1, y1, x2, y2] of state.segments ?? [])
    (pen.moveTo(camera.across(x1, y1), camera.down(x1, y1)), pen.lineTo(camera.across(x2, y2), camera.down(x2, y2)));
  pen.strokeStyle = theme.colours.segment;
  pen.lineWidth = 2.5;
  pen.lineCap = "round";
  pen.stroke();
  pen.lineCap = "butt";
}

function drawTrail(pen, camera, points, colour) {
  if (points.length < 2) return;
  pen.beginPath();
  traceOnScreen(pen, camera, points);
  pen.strokeStyle = colour;
  pen.globalAlpha = 0.55;
  pen.lineWidth = 2;
  pen.lineJoin = "round";
  pen.stroke();
  pen.globalAlpha = 1;
}

/**
 * The state of the robot's goal `i`: "next", "reached", "passed" if it may have been reached or not, or "". A frame
 * has only the number of goals reached: if it is the number of those before the next one, all of them were.
 */
function goalState({goal: next, goals_reached: reached}, i, count) {
  if (i === next) return "next";
  const before = next < 0 ? count : next;
  if (i >= before) return "";
  if (reached === before) return "reached";
  return next < 0 ? "" : "passed";
}

/** Goals known to be reached have a tick, the next one is filled, all others are rings with their numbers. */
function drawGoals(pen, camera, robot, state, names) {
  const colour = theme.colours.goal,
    size = 8;
  pen.font = "600 11px system-ui, sans-serif";
  pen.textAlign = "center";
  robot.goals.forEach((goal, i) => {
    const u = camera.across(goal.x, goal.y),
      v = camera.down(goal.x, goal.y),
      known = goalState(state, i, robot.goals.length),
      next = known === "next";
    pen.beginPath();
    pen.arc(u, v, size, 0, 2 * Math.PI);
    pen.fillStyle = next ? colour : theme.colours.floor;
    pen.fill();
    pen.strokeStyle = colour;
    pen.lineWidth = next ? 3 : 1.75;
    pen.stroke();
    if (known === "reached") {
      pen.beginPath();
      (pen.moveTo(u - 3.5, v), pen.lineTo(u - 1, v + 3), pen.lineTo(u + 4, v - 3.5));
      pen.stroke();
    } else {
      pen.fillStyle = next ? theme.colours.floor : theme.colours.text;
      pen.textBaseline = "middle";
      pen.fillText(String(i + 1), u, v + 0.5);
    }
    if (names && goal.name) {
      pen.textBaseline = "top";
      haloText(pen, goal.name, u, v + size + 4);
    }
  });
}
