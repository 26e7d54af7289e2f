// SPDX-License-Identifier: BSD-3-Clause
// The timeline's rows: a lane for each task, in groups of robots and modules that can be closed to one row.

const ROW = 20,
  GROUP_ROW = 22;

class TimelineRows {
  constructor(session) {
    this.session = session;
    this.closed = new Set();
    this.opened = new Set();
    this.rows = [];
    this.height = 0;
    this.wanted = ""; // only tasks with this in their names or their robots'
    this.tasks = [];
    this.rowOf = new Map();
  }

  /** tasks: {key, name, robot, number}; the rows keep their state by name. */
  set(tasks) {
    if (tasks.length === this.tasks.length && tasks.every((task, i) => task.key === this.tasks[i].key)) return;
    this.tasks = tasks;
    this.layOut();
  }

  isClosed(key, robots) {
    if (this.closed.has(key)) return true;
    // Many robots begin closed, except the one that is selected.
    return (
      key.startsWith("robot ") &&
      robots > 6 &&
      key !== "robot environment" &&
      !this.opened.has(key) &&
      key !== `robot ${this.session.robotName}`
    );
  }

  toggle(key) {
    const robots = new Set(this.tasks.map((task) => task.robot)).size;
    if (this.isClosed(key, robots)) (this.closed.delete(key), this.opened.add(key));
    else (this.closed.add(key), this.opened.delete(key));
    this.layOut();
  }

  layOut() {
    const robots = new Map(),
      wanted = this.wanted.toLowerCase();
    for (const task of this.tasks) {
      if (wanted && !`${task.robot} ${task.name}`.toLowerCase().includes(wanted)) continue;
      if (!robots.has(task.robot)) robots.set(task.robot, []);
      robots.get(task.robot).push(task);
    }
    this.rows = [];
    this.rowOf = new Map();
    let y = 0;
    const add = (row) => {
      row.y = y;
      y += row.height;
      this.rows.push(row);
      for (const task of row.tasks) if (row.kind !== "robot" || row.closed) this.rowOf.set(task.key, row);
    };
    for (const [robot, tasks] of robots) {
      const key = `robot ${robot}`,
        closed = this.isClosed(key, robots.size);
      add({kind: "robot", key, closed, label: robot, height: GROUP_ROW, tasks});
      if (!closed) for (const row of moduleRows(robot, tasks, this.closed)) add(row);
    }
    this.height = y;
  }

  /** The row at a height, or null. */
  at(y) {
    const index = firstWhere(this.rows.length, (i) => this.rows[i].y + this.rows[i].height > y);
    return y >= 0 && index < this.rows.length ? this.rows[index] : null;
  }

  visible(top, height) {
    const first = firstWhere(this.rows.length, (i) => this.rows[i].y + this.rows[i].height > top);
    const end = firstWhere(this.rows.length, (i) => this.rows[i].y >= top + height);
    return this.rows.slice(first, end);
  }
}

/**
 * Tasks "module.task" by module; a module that is closed has one row for all its tasks. Others are rows of their own.
 */
function moduleRows(robot, tasks, closed) {
  const modules = new Map();
  for (const task of tasks) {
    const dot = task.name.indexOf("."),
      module = dot > 0 ? task.name.slice(0, dot) : "";
    const key = module ? `module ${robot} ${module}` : `task ${task.key}`;
    if (!modules.has(key)) modules.set(key, {module, tasks: []});
    modules.get(key).tasks.push(task);
  }
  const rows = [];
  let odd = false;
  for (const [key, {module, tasks: own}] of modules) {
    odd = !odd;
    if (module && closed.has(key))
      rows.push({
        kind: "module",
        key,
        closed: true,
        module,
        label: `${own.length} tasks`,
        height: ROW,
        tasks: own,
        odd
      });
    else
      own.forEach((task, i) =>
        rows.push({
          kind: "task",
          key: module && i === 0 ? key : null,
          closed: false,
          module: i === 0 ? module : "",
          label: module ? task.name.slice(module.length + 1) : task.name,
          height: ROW,
          tasks: [task],
          odd
        })
      );
  }
  return rows;
}
