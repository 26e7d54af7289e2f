// SPDX-License-Identifier: BSD-3-Clause
// The plan's tools: fit, follow, oblique, measure, layers; and the plan in words for screen readers.

class PlanTools {
  constructor(session, view, repaint) {
    Object.assign(this, {session, view, repaint, measuring: false});
    const on = (id, action) => byId(id).addEventListener("click", action);
    on("fit", () => view.fit());
    on("follow", () => this.toggleFollow());
    on("oblique", () => this.toggleOblique());
    on("measure", () => this.toggleMeasure());
    on("layers", () => this.toggleMenu());
    session.on("follow", () => {
      byId("follow").setAttribute("aria-pressed", String(session.following));
      repaint();
    });
    this.makeMenu();
    session.on("theme layers", () => this.updateMenu());
  }

  toggleFollow() {
    this.session.follow(!this.session.following);
    const {camera} = this.view,
      {following, header, robot} = this.session;
    // From afar a robot is hard to see; it is followed close by.
    if (following && camera.scale * reachOf(header.robots[robot]) < 8)
      camera.scale = 16 / reachOf(header.robots[robot]);
    camera.fitted = false;
    this.repaint();
  }

  toggleOblique() {
    const {camera} = this.view,
      on = !camera.oblique;
    camera.tilt = on ? 0.85 : Math.PI / 2;
    camera.turn = on ? -0.35 : 0;
    if (camera.fitted) camera.fit(this.view.bounds());
    camera.update();
    byId("oblique").setAttribute("aria-pressed", String(on));
    this.repaint();
  }

  toggleMeasure(on = !this.measuring) {
    this.measuring = on;
    if (!on) this.view.measure = null;
    byId("measure").setAttribute("aria-pressed", String(on));
    byId("plan").classList.toggle("measuring", on);
    setText(byId("pointer"), on ? "Drag from one place to another." : "");
    this.repaint();
  }

  toggleMenu(on = byId("layer-menu").hidden) {
    byId("layer-menu").hidden = !on;
    byId("layers").setAttribute("aria-expanded", String(on));
    if (on) byId("layer-menu").querySelector("input").focus();
    else if (byId("layer-menu").contains(document.activeElement)) byId("layers").focus();
  }

  makeMenu() {
    const trail = element(
      "select",
      {
        "aria-label": "Length of the trail",
        onchange: (event) => {
          this.session.trail = Number(event.target.value);
          this.session.changed("layers");
        }
      },
      [
        [10, "10 s"],
        [60, "1 min"],
        [600, "10 min"],
        [1e9, "all"]
      ].map(([seconds, name]) => element("option", {value: seconds * SECOND, selected: seconds === 60}, name))
    );
    this.boxes = LAYERS.map((layer) => {
      const box = element("input", {
        type: "checkbox",
        checked: layer.on,
        onchange: () => this.session.toggleLayer(layer.key)
      });
      const swatch = element("span", {class: "swatch", "aria-hidden": "true"});
      byId("layer-menu").append(
        element(
          "div",
          {class: "layer"},
          element("label", {}, box, swatch, layer.name),
          layer.key === "trail" ? trail : null
        )
      );
      return {layer, box, swatch};
    });
    this.updateMenu();
  }

  updateMenu() {
    const colours = theme.colours;
    const swatches = {
      grid: colours.grid,
      furniture: colours.furniture,
      unknown: colours.unknownLine,
      trail: colours.robots[0],
      laser: `${colours.laser}66`,
      sonar: `${colours.sonar}88`,
      route: colours.route,
      goals: colours.goal,
      estimate: colours.estimate,
      covariance: `${colours.estimate}44`,
      odometry: colours.odometry,
      segments: colours.segment
    };
    for (const {layer, box, swatch} of this.boxes) {
      box.checked = this.session.layers[layer.key];
      swatch.style.background = swatches[layer.key] ?? "none";
    }
  }

  /** The selected robot's situation, in a sentence. */
  describe() {
    const {session} = this,
      state = session.frame?.robots[session.robot];
    if (!state) return setText(byId("plan-text"), "No robot.");
    const {goals} = session.header.robots[session.robot],
      [x, y, heading] = state.truth;
    setText(
      byId("plan-text"),
      `At ${shortInstantText(session.time)} ${session.robotName} is at ${placeText(x, y)}, heading ${degrees(heading)}, with ${state.goals_reached} of ${goals.length} goals reached and ${state.collisions} collisions.`
    );
  }
}
