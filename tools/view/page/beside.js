// SPDX-License-Identifier: BSD-3-Clause
// Two lines of time side by side: a second plan with the same camera, a second timeline on the same axis.

class Beside {
  constructor(session, clock, parts) {
    Object.assign(this, {session, clock, parts, plan: null, timeline: null});
    session.on("beside", () => this.update());
    session.on("compare", () => this.repaint());
    session.on("line", () => {
      if (session.compared?.line === session.line) session.compared = null;
      this.update();
    });
  }

  update() {
    const {session, parts} = this,
      on = session.compared !== null;
    byId("plan-beside").hidden = !on;
    if (on && !this.plan) this.make();
    const name = (number) =>
      `line ${number}: ${session.source.status.lines.find((line) => line.line === number)?.name ?? ""}`;
    parts.plan.title = on ? name(session.line) : "";
    if (on) this.plan.title = name(session.compared.line);
    if (this.host) this.host.hidden = !on;
    // Two timelines share the height of one.
    const part = byId("timeline");
    if (on && part.offsetHeight < 400) part.style.height = "400px";
    parts.timeline.marks = this.marksOf(session.line);
    if (on) this.timeline.marks = this.marksOf(session.compared.line);
    if (on && this.shown !== session.compared.line) this.timeline.data.forget();
    this.shown = session.compared?.line;
    this.repaint();
  }

  marksOf(line) {
    const {compared, source} = this.session,
      found = compared?.difference,
      marks = source.marks?.(line) ?? [];
    if (!found?.event || marks.some(({number}) => number === found.event)) return marks;
    return [{time: found.time, number: found.event, text: "the first event that differs"}, ...marks];
  }

  make() {
    const {session, parts, clock} = this,
      frame = () => session.compared?.frame,
      line = () => session.compared?.line;
    this.plan = new PlanView(byId("plan-canvas-beside"), session, parts.camera, frame, line);
    new PlanGestures(this.plan, session, {
      repaint: parts.repaintPlans,
      measuring: () => false,
      status: (text) => setText(byId("pointer"), text)
    });
    this.host = element("div", {class: "lanes-of"});
    byId("lanes").append(this.host);
    // Below each other, since the axis is the same.
    this.timeline = new TimelineView(this.host, session, parts.axis, line, frame);
    new TimelineGestures(this.timeline, session, parts.axis, clock, byId("tip"));
    parts.axis.listeners.push(() => this.session.compared && this.timeline.viewChanged());
  }

  repaint() {
    this.parts.plan.surface.invalidate();
    this.parts.timeline.surface.invalidate();
    if (!this.session.compared || !this.plan) return;
    this.plan.surface.invalidate();
    this.timeline.moveCursor();
    this.timeline.surface.invalidate();
  }
}
