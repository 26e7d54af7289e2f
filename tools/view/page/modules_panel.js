// SPDX-License-Identifier: BSD-3-Clause
// The selected robot's modules: activities, tasks with their periods, requests, and posters with their ages.

class ModulesPanel {
  constructor(panel, session, plot) {
    this.session = session;
    this.plot = plot; // adds a plot of {robot, poster, field}
    this.note = element("p", {class: "note"});
    this.tasks = new TextTable("Tasks", ["Task", "Period", "Missed periods", "Missed deadlines", "Latest"]);
    this.activities = new TextTable("Activities", ["Activity", "Number", "State"]);
    this.posters = element("div");
    this.requests = element("div");
    panel.append(
      this.note,
      this.activities.table,
      this.tasks.table,
      element("h2", {}, "Posters"),
      this.posters,
      element("h2", {}, "Requests"),
      this.requests
    );
    this.opened = new Map(); // posters' elements by name
    this.asked = 0;
    session.on("robot", () => this.showRequests());
    this.showRequests();
  }

  async update() {
    const {session} = this,
      asked = ++this.asked;
    if (!session.frame || session.header.robots.length === 0) return setText(this.note, "This run has no robots.");
    const state = await session.source.modules(session.line, session.robot).catch((error) => ({error: error.message}));
    if (asked !== this.asked) return;
    if (!state || state.error)
      return setText(this.note, state?.error ?? `Nothing is recorded of ${session.robotName}'s modules.`);
    const ended = state.time !== session.time && session.source.kind === "recorded";
    setText(
      this.note,
      `Modules of ${session.robotName} at ${shortInstantText(state.time)}${ended ? ", the end of the recorded run; fields that were recorded, at the cursor" : ""}`
    );
    this.activities.set(
      state.modules.flatMap((module) =>
        module.activities.map((one) => [`${module.name} ${one.request}`, String(one.number), one.state])
      )
    );
    this.activities.table.hidden = this.activities.rows.length === 0;
    const tasks = state.modules.flatMap((module) => module.tasks.map((task) => ({module, task})));
    this.tasks.set(
      tasks.map(({module, task}) => [
        `${module.name}.${task.name}`,
        task.suspended ? "suspended" : spanText(task.period),
        String(task.missed_periods),
        String(task.missed_deadlines),
        task.greatest_lateness ? spanText(task.greatest_lateness) : "–"
      ])
    );
    this.tasks.rows.forEach((row, i) =>
      row.classList.toggle("bad", tasks[i].task.missed_deadlines > 0 || tasks[i].task.missed_periods > 0)
    );
    this.showPosters(state);
  }

  showPosters(state) {
    const {session} = this,
      shapes = new Map((session.header.robots[session.robot].posters ?? []).map((poster) => [poster.name, poster]));
    const names = state.posters.map((poster) => poster.name).join();
    if (names !== this.names || this.shownRobot !== session.robot) {
      this.opened.clear();
      this.posters.replaceChildren(
        ...state.posters.map((poster) => {
          const age = element("span", {class: "age"}),
            body = element("div"),
            box = element(
              "details",
              {class: "poster", ontoggle: () => this.update()},
              element("summary", {}, poster.name, " ", age),
              body
            );
          this.opened.set(poster.name, {box, age, body, text: null});
          return box;
        })
      );
      Object.assign(this, {names, shownRobot: session.robot});
    }
    for (const poster of state.posters) {
      const shown = this.opened.get(poster.name);
      setText(
        shown.age,
        poster.text === null
          ? "never written"
          : poster.date === null
            ? ""
            : `${spanText(Math.max(0, state.time - poster.date))} old`
      );
      const current = this.recordedFields(poster.name),
        text = `${poster.text}${JSON.stringify(current)}`;
      if (!shown.box.open || text === shown.text) continue;
      shown.text = text;
      const fields =
        poster.text === null
          ? []
          : tclFields(poster.text, shapes.get(poster.name)?.fields ?? {kind: "record", parts: []});
      const buttons = session.source
        .plottable()
        .filter((one) => one.robot === session.robot && one.poster === poster.name)
        .map((one) => element("button", {class: "link", onclick: () => this.plot(one)}, `plot ${one.field}`));
      shown.body.replaceChildren(
        fieldList(current.length ? current : fields),
        element("div", {class: "row"}, buttons.slice(0, 30))
      );
    }
  }

  /** Of a recorded run the fields that have plots are known at any time. */
  recordedFields(poster) {
    const {session} = this;
    if (session.source.kind !== "recorded") return [];
    return (session.source.run.plots ?? [])
      .filter((plot) => plot.robot === session.robot && plot.poster === poster)
      .map((plot) => {
        const times = plot.t ?? session.source.run.plot_times,
          next = firstWhere(times.length, (i) => times[i] > session.time);
        return {name: plot.field, value: next > 0 ? String(plot.v[next - 1]) : "–"};
      });
  }

  showRequests() {
    const modules = this.session.header.robots[this.session.robot]?.modules ?? [];
    this.requests.replaceChildren(
      ...modules.map((module) =>
        element(
          "p",
          {},
          element("strong", {}, `${module.name}: `),
          module.requests.map((request) => request.name).join(", ") || "none"
        )
      )
    );
  }
}
