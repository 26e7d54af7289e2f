// SPDX-License-Identifier: BSD-3-Clause
// The table of robots: the plan's contents as text, and the selected robot's in more detail.

const MOST_ROWS = 60; // of many robots only the selected one's neighbours in the list

class RobotsPanel {
  constructor(panel, session) {
    this.session = session;
    this.table = new TextTable("Robots", ["Robot", "x m", "y m", "Heading", "Goals", "Collisions"]);
    this.detail = new TextTable("", ["Pose", "x m", "y m", "Heading"]);
    this.goals = new TextTable("Goals", ["Goal", "x m", "y m", "State"]);
    this.note = element("p", {class: "note"});
    this.panel = panel;
    this.first = 0;
    panel.append(this.table.table, this.note, this.detail.table, this.goals.table);
  }

  update() {
    const {session} = this,
      {robots} = session.header,
      frame = session.frame;
    if (!frame || robots.length === 0) return setText(this.note, "This run has no robots.");
    this.first = Math.max(0, Math.min(session.robot - MOST_ROWS / 2, robots.length - MOST_ROWS));
    const shown = robots.slice(this.first, this.first + MOST_ROWS);
    setText(this.note, robots.length > MOST_ROWS ? `${MOST_ROWS} of ${robots.length} robots.` : "");
    this.table.set(
      shown.map((robot, i) => this.row(robot, frame.robots[this.first + i])),
      {marked: session.robot - this.first, choose: (i) => session.selectRobot(this.first + i)}
    );
    this.updateDetail(robots[session.robot], frame.robots[session.robot]);
  }

  row(robot, state) {
    if (!state) return [robot.name, "not in view", "", "", "", ""];
    const [x, y, heading] = state.truth;
    return [
      robot.name,
      x.toFixed(3),
      y.toFixed(3),
      degrees(wrapped(heading)),
      robot.goals.length ? `${state.goals_reached} of ${robot.goals.length}` : "–",
      String(state.collisions)
    ];
  }

  updateDetail(robot, state) {
    setText(this.detail.table.caption, `Poses of ${robot.name}`);
    const pose = (name, value) => [
      name,
      ...(value ? [value[0].toFixed(3), value[1].toFixed(3), degrees(wrapped(value[2]))] : ["–", "–", "–"])
    ];
    const rows = state
      ? [pose("true", state.truth), pose("estimated", state.estimate), pose("odometry", state.odometry)]
      : [];
    if (state?.estimate) {
      const {truth, estimate} = state;
      rows.push([
        "error",
        `${Math.hypot(estimate[0] - truth[0], estimate[1] - truth[1]).toFixed(3)} in all`,
        "",
        degrees(wrapped(estimate[2] - truth[2]))
      ]);
    }
    if (state && (state.truth[3] ?? 0) !== 0) rows.push(["height", state.truth[3].toFixed(3), "", ""]);
    this.detail.set(rows);
    this.goals.table.hidden = robot.goals.length === 0;
    if (state)
      this.goals.set(
        robot.goals.map((goal, i) => [
          `${i + 1} ${goal.name ?? ""}`,
          goal.x.toFixed(2),
          goal.y.toFixed(2),
          goalState(state, i, robot.goals.length)
        ]),
        {marked: state.goal}
      );
  }
}
