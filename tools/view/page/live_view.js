// SPDX-License-Identifier: BSD-3-Clause
// Messages that a live source pushes, and the page's subscription to frames: only of the visible part.

function connectSource(session, clock, parts) {
  const {source} = session,
    {axis, timeline, camera} = parts;
  if (source.kind !== "live") return;
  const growing = seldom(700, () => {
    if (axis.whole) axis.showAll();
    return timeline.data.need();
  });
  const counting = seldom(2500, async () => {
    await timeline.data.loadCounts();
    parts.transport.overview.invalidate();
  });
  let known = 0;
  source.on("frame", (frame) => {
    if (clock.live && frame.line === session.line) session.show(frame);
  });
  source.on("status", () => {
    if (source.status.over && clock.live) {
      clock.setLive(false);
      clock.seek(clock.end);
    }
    session.changed("run");
    const far = axis.end;
    if (far === known) return;
    known = far;
    growing();
    counting();
  });
  source.on("log", () => session.changed("log"));
  source.on("connection", () => {
    session.changed("source");
    if (source.connection.state !== "open") return;
    timeline.data.need();
    if (!clock.live && !clock.busy) clock.seek(session.time);
  });
  const few = session.header.robots.length <= FEW_ROBOTS;
  const follow = () =>
    source.follow(clock.live, {
      view: session.header.robots.length > 50 && !session.following ? widened(camera.bounds()) : null,
      robot: few ? null : session.robot
    });
  const followSoon = seldom(250, follow);
  clock.listeners.push(follow);
  session.on("time follow layers", followSoon);
  session.on("line", () => timeline.data.forget());
  session.on("robot", () => {
    follow();
    if (!few && !clock.live) clock.seek(session.time);
  });
  follow();
}

/** Bounds with a margin, to whole metres: so small movements of the camera ask for nothing new. */
function widened([left, bottom, right, top]) {
  const margin = 0.15 * Math.max(right - left, top - bottom),
    unit = Math.max(1, Math.round(margin / 2));
  return [left - margin, bottom - margin, right + margin, top + margin].map(
    (value, i) => (i < 2 ? Math.floor(value / unit) : Math.ceil(value / unit)) * unit
  );
}
