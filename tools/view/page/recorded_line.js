// SPDX-License-Identifier: BSD-3-Clause
// One line of time of a recorded run: its frames and events.

const NO_EVENTS = {t: [], k: [], o: [], x: [], tasks: [], objects: [], from: 0, to: 0, first: 1, complete: true};

class RecordedLine {
  constructor(run, header) {
    this.run = run;
    this.frames = run.frames ?? [];
    if (this.frames.length === 0) this.frames.push({kind: "frame", line: 0, time: 0, events: 0, robots: []});
    this.store = new EventStore(run.events ?? NO_EVENTS, header.operations);
    const last = this.store.count ? this.store.time.at(-1) : 0;
    this.to = Math.max(this.frames.at(-1).time, this.store.waits ? this.store.to : last);
    this.complete(header);
  }

  /**
   * Scans, routes and the like are in a frame only when they are new: here each frame gets those that are still valid.
   */
  complete(header) {
    let obstacles = header.obstacles;
    const kept = header.robots.map(() => ({}));
    for (const frame of this.frames) {
      obstacles = frame.obstacles ?? obstacles;
      frame.obstacles = obstacles;
      frame.robots.forEach((robot, index) => robot && carryOver(kept[index], robot));
    }
  }

  /** True if the events up to `time` are there: of a long run only the first ones are kept. */
  keeps(time) {
    return this.store.complete || time <= this.store.to;
  }

  needKept(kept) {
    if (!kept) throw new Error(`Events are kept up to ${shortInstantText(this.store.to)}.`);
  }

  /** Poses between two frames are interpolated, so that a run plays smoothly; the rest is the earlier frame's. */
  frameAt(time, executed) {
    const next = firstWhere(this.frames.length, (i) => this.frames[i].time > time);
    const frame = this.frames[Math.max(0, next - 1)],
      after = this.frames[next];
    const counted = this.store.count > 0 && this.keeps(time);
    const events = executed ?? (counted ? this.store.first - 1 + this.store.at(time + 1) : frame.events);
    if (!after || time === frame.time) return {...frame, time, events};
    const part = (time - frame.time) / (after.time - frame.time);
    const robots = frame.robots.map((robot, index) =>
      robot && after.robots[index] ? between(robot, after.robots[index], part) : robot
    );
    return {...frame, time, events, robots};
  }

  /** The frame after `count` more events (fewer, if negative), of the task of that number if one is given. */
  step(count, task, from) {
    this.needKept(this.keeps(from.time));
    const store = this.store,
      executed = from.events - (store.first - 1);
    const lane = task === null ? null : store.lanes[store.tasks.findIndex((one) => one.number === task)];
    const done = lane ? firstWhere(lane.length, (i) => lane[i] >= executed) : executed;
    const most = lane ? lane.length : store.count;
    this.needKept(store.complete || done + count <= most);
    const target = Math.max(0, Math.min(done + count, most));
    if (target === 0) return {...this.frameAt(0, store.first - 1), event: null};
    const index = lane ? lane[target - 1] : target - 1;
    const event = store.describe(index);
    return {...this.frameAt(event.time, event.number), event};
  }

  tasks(frame) {
    this.needKept(this.keeps(frame.time));
    const executed = frame.events - (this.store.first - 1);
    return this.store.tasks.length
      ? this.store.tasks.map((task, index) => taskAt(this.store, index, executed, frame.time))
      : (this.run.tasks?.tasks ?? []);
  }

  /** The robot's true places up to `time`, of frames no older than `span`. */
  trail(robot, time, span) {
    const end = firstWhere(this.frames.length, (i) => this.frames[i].time > time);
    const begin = firstWhere(end, (i) => this.frames[i].time >= time - span);
    return this.frames
      .slice(begin, end)
      .map((frame) => frame.robots[robot]?.truth)
      .filter(Boolean);
  }
}

/** The header with each robot's type in the robot: the common part of a crowd's robots comes once. */
function withTypes(header) {
  for (const robot of header.robots) Object.assign(robot, header.types?.[robot.type]);
  return header;
}

/** Completes a robot's frame by the parts that it leaves out as unchanged. A scan keeps the pose at which it was taken. */
function carryOver(kept, robot) {
  if (robot.scans) robot.scans.forEach((scan) => (scan.pose ??= robot.truth));
  for (const name of ["scans", "sonars", "route", "segments"]) {
    if (robot[name] === undefined) robot[name] = kept[name];
    else kept[name] = robot[name];
  }
}

function between(robot, after, part) {
  const pose = (a, b) =>
    !a || !b
      ? a
      : a.map((value, i) => (i === 2 ? value + wrapped(b[i] - value) * part : value + (b[i] - value) * part));
  return {
    ...robot,
    truth: pose(robot.truth, after.truth),
    estimate: pose(robot.estimate, after.estimate),
    odometry: pose(robot.odometry, after.odometry)
  };
}
