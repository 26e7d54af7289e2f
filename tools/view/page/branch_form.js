// SPDX-License-Identifier: BSD-3-Clause
// A branch at the cursor: interventions, as the prompt of an interactive run has them, and another seed from there on.

class BranchForm {
  /** branched: told the number of the new line. */
  constructor(panel, session, branched) {
    Object.assign(this, {session, branched});
    this.kind = element(
      "select",
      {"aria-label": "Kind of intervention", onchange: () => this.showFields()},
      ["move", "request", "obstacle", "move-obstacle", "remove-obstacle", "push"].map((kind) =>
        element("option", {value: kind}, kind)
      )
    );
    this.fields = element("span", {class: "row", oninput: () => (this.filled = true)});
    this.lines = element("textarea", {
      rows: 4,
      "aria-label": "Interventions, one a line",
      spellcheck: "false",
      placeholder: "move rackham 21 4.5 45"
    });
    this.seed = element("input", {
      type: "text",
      inputmode: "numeric",
      size: 8,
      "aria-label": "Seed from here on",
      placeholder: "as before"
    });
    this.go = element("button", {class: "primary", onclick: () => this.branch()}, "Branch here");
    this.note = element("p", {class: "note", role: "status"});
    this.root = element(
      "div",
      {},
      element("h2", {}, "Branch"),
      element("div", {class: "row"}, this.kind, this.fields, element("button", {onclick: () => this.add()}, "Add")),
      this.lines,
      element("div", {class: "row"}, element("label", {}, "Seed ", this.seed), this.go),
      this.note
    );
    // A recorded run has no branches.
    this.root.hidden = session.source.kind !== "live";
    panel.append(this.root);
    session.on("robot", () => this.showFields());
    session.on("place", () => {
      if (!this.place) return;
      this.place[0].value = session.place.x.toFixed(2);
      this.place[1].value = session.place.y.toFixed(2);
      this.filled = true;
    });
    this.showFields();
  }

  update() {
    const {source, time} = this.session,
      able = source.control;
    setText(this.go, `Branch at ${shortInstantText(time)}`);
    this.go.disabled = !able;
    if (!able) setText(this.note, "The program allows no branches: waitpoint run --serve --serve-control does.");
  }

  /** The fields of the chosen kind, filled with the present values. */
  showFields() {
    const {session} = this,
      robot = session.header.robots[session.robot],
      pose = session.frame?.robots[session.robot]?.truth ?? [0, 0, 0];
    const text = (label, value, size = 6) =>
      element("input", {
        type: "text",
        size,
        value,
        "aria-label": label,
        title: label,
        placeholder: label,
        autocomplete: "off"
      });
    const choice = (label, names, change) =>
      element(
        "select",
        {"aria-label": label, onchange: change},
        names.map((name) => element("option", {value: name}, name))
      );
    const x = text("x in m", pose[0].toFixed(2)),
      y = text("y in m", pose[1].toFixed(2)),
      heading = text("heading in degrees", ((wrapped(pose[2]) * 180) / Math.PI).toFixed(0));
    const obstacles = (session.frame?.obstacles ?? session.header.obstacles).map((obstacle) => obstacle.name);
    const name = robot?.name ?? "";
    const kinds = {
      move: () => [[x, y, heading], () => `move ${name} ${x.value} ${y.value} ${heading.value}`],
      request: () => this.requestFields(robot, choice, text),
      obstacle: () => {
        const label = text("name", "box"),
          width = text("length in m", "0.5", 4),
          depth = text("width in m", "0.5", 4);
        return [
          [label, x, y, width, depth],
          () =>
            `obstacle {name: ${label.value}, centre_m: [${x.value}, ${y.value}], size_m: [${width.value}, ${depth.value}]}`
        ];
      },
      "move-obstacle": () => {
        const which = choice("obstacle", obstacles);
        return [[which, x, y, heading], () => `move-obstacle ${which.value} ${x.value} ${y.value} ${heading.value}`];
      },
      "remove-obstacle": () => {
        const which = choice("obstacle", obstacles);
        return [[which], () => `remove-obstacle ${which.value}`];
      },
      push: () => {
        const which = choice("body", [...(name ? [name] : []), ...obstacles]),
          fx = text("force along x in N", "30"),
          fy = text("force along y in N", "0"),
          seconds = text("duration in s", "0.5");
        return [[which, fx, fy, seconds], () => `push ${which.value} ${fx.value} ${fy.value} ${seconds.value}`];
      }
    };
    const [inputs, line] = kinds[this.kind.value]();
    this.line = line;
    this.place = inputs.includes(x) ? [x, y] : null;
    this.fields.replaceChildren(...inputs);
    this.filled = false; // by the user, and not yet added
  }

  /**
   * A request of one of the robot's modules, with an input for each of its fields; those left empty keep their
   * defaults.
   */
  requestFields(robot, choice, text) {
    const modules = robot?.modules ?? [],
      inputs = element("span", {class: "row"});
    const request = choice(
      "request",
      modules.flatMap((module) => module.requests.map((one) => `${module.name} ${one.name}`)),
      () => show()
    );
    let fields = [];
    const show = () => {
      const [module, name] = request.value.split(" "),
        shape = modules.find((one) => one.name === module)?.requests.find((one) => one.name === name)?.fields;
      fields = leaves(shape).map((path) => ({path, input: text(path, "", 8)}));
      inputs.replaceChildren(...fields.map((field) => field.input));
    };
    show();
    return [
      [request, inputs],
      () =>
        [
          `request ${robot?.name} ${request.value}`,
          ...fields
            .filter((field) => field.input.value.trim())
            .map((field) => `${field.path}=${field.input.value.trim()}`)
        ].join(" ")
    ];
  }

  add() {
    this.lines.value = [this.lines.value.trimEnd(), this.line()].filter(Boolean).join("\n");
    this.filled = false;
  }

  /** Fields that are filled in but not added are an intervention as well. */
  async branch() {
    if (this.filled) this.add();
    const {session} = this,
      interventions = this.lines.value
        .split("\n")
        .map((line) => line.trim())
        .filter(Boolean),
      seed = this.seed.value.trim();
    if (seed) interventions.unshift(`seed ${seed}`);
    setText(this.note, "…");
    try {
      const {line} = await session.source.branch(session.line, session.time, interventions);
      setText(this.note, `Line ${line} is shown now.`);
      this.lines.value = "";
      this.branched(line);
    } catch (error) {
      setText(this.note, error.message);
    }
  }
}

/** Paths of a shape's values: elements of a list are told by one, the first. */
function leaves(shape, path = []) {
  if (!shape || shape.kind === "value") return shape && path.length ? [path.join(".")] : [];
  return shape.parts.flatMap((part) =>
    leaves(
      part,
      [
        ...path,
        shape.kind === "list" ? "0" : null,
        shape.kind === "list" && shape.parts.length === 1 ? null : part.name
      ].filter((name) => name)
    )
  );
}
