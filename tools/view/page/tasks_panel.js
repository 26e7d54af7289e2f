// SPDX-License-Identifier: BSD-3-Clause
// The tasks at the cursor: their states and waits.

class TasksPanel {
  constructor(panel, session, choose) {
    this.session = session;
    this.choose = choose; // told a task's name and robot
    this.all = element("input", {type: "checkbox", onchange: () => this.update()});
    this.table = new TextTable("Tasks", ["Task", "State", "Since", "Waits for, or does"]);
    this.asked = 0;
    this.note = element("p", {class: "note", role: "status"});
    panel.append(element("label", {class: "row"}, this.all, "of all robots"), this.table.table, this.note);
  }

  async update() {
    const {session} = this,
      asked = ++this.asked;
    if (!session.frame) return;
    let refusal = "";
    const tasks = await session.source.tasks(session.line, session.frame).catch((error) => {
      refusal = error.message;
      return [];
    });
    if (asked !== this.asked) return; // the cursor has moved on
    setText(this.note, refusal);
    const shown = tasks
      .filter(
        (task) =>
          this.all.checked ||
          task.robot === session.robotName ||
          !session.header.robots.some((robot) => robot.name === task.robot)
      )
      .slice(0, 400);
    const several = new Set(shown.map((task) => task.robot)).size > 2;
    setText(this.table.table.caption, `Tasks at ${shortInstantText(session.time)}`);
    this.table.set(
      shown.map((task) => [
        several ? `${task.robot} ${task.name}` : task.name,
        task.state,
        task.local ? shortInstantText(task.local) : "–",
        doingText(task)
      ]),
      {
        marked: shown.findIndex((task) => task.name === session.event?.task && task.robot === session.event?.robot),
        choose: (i) => this.choose(shown[i])
      }
    );
  }
}

function doingText(task) {
  const {object} = task,
    parts = [];
  if (object) parts.push(`${task.operation} ${objectText(object)}${object.owner ? `, held by ${object.owner}` : ""}`);
  else if (task.operation) parts.push(task.operation);
  if (task.work) parts.push(task.work);
  if (task.deadline !== null && task.deadline !== undefined) parts.push(`until ${shortInstantText(task.deadline)}`);
  return parts.join(", ");
}
