// SPDX-License-Identifier: BSD-3-Clause
// The parts of the page, and their notifications of changes.

function buildParts(session, clock) {
  const axis = new TimeAxis(session),
    camera = new Camera(),
    parts = {axis, camera};
  parts.plan = new PlanView(
    byId("plan-canvas"),
    session,
    camera,
    () => session.frame,
    () => session.line
  );
  parts.repaintPlans = () => {
    parts.plan.surface.invalidate();
    parts.beside?.plan?.surface.invalidate();
  };
  parts.planTools = new PlanTools(session, parts.plan, parts.repaintPlans);
  parts.planGestures = new PlanGestures(parts.plan, session, {
    repaint: parts.repaintPlans,
    measuring: () => parts.planTools.measuring,
    status: (text) => setText(byId("pointer"), text)
  });
  const host = element("div", {class: "lanes-of"});
  byId("lanes").append(host);
  parts.timeline = new TimelineView(
    host,
    session,
    axis,
    () => session.line,
    () => session.frame
  );
  parts.timelineGestures = new TimelineGestures(parts.timeline, session, axis, clock, byId("tip"));
  parts.transport = new Transport(session, clock, axis);
  parts.transport.counts = () => parts.timeline.data.counts;
  parts.tabs = new Tabs(byId("tabs"), byId("panels"));
  parts.panels = new Map();
  const panel = (key, name, make) => parts.panels.set(key, make(parts.tabs.add(key, name)));
  if (session.source.finding) panel("finding", "Finding", (at) => new FindingPanel(at, session, axis));
  const hasRobots = session.header.robots.length > 0;
  if (hasRobots) panel("robots", "Robots", (at) => new RobotsPanel(at, session));
  panel("tasks", "Tasks", (at) => new TasksPanel(at, session, (task) => selectTask(session, parts, task)));
  if (hasRobots) panel("modules", "Modules", (at) => new ModulesPanel(at, session, (wanted) => parts.plots.add(wanted)));
  panel("event", "Event", (at) => new EventPanel(at, session, clock, () => parts.timelineGestures));
  panel("log", "Log", (at) => new LogPanel(at, session, clock));
  panel("lines", "Lines", (at) => new LinesPanel(at, session, clock, axis));
  panel("run", "Run", (at) => new RunPanel(at, session, report, () => parts.timeline.data.counts));
  parts.beside = new Beside(session, clock, parts);
  parts.plots = new PlotsView(session, axis, clock);
  makeSplitter(byId("split-side"), byId("side"), 160);
  makeSplitter(byId("split-lower"), byId("timeline"), 70);
  drawLegend();
  return parts;
}

function connectParts(session, clock, parts) {
  const {axis, timeline, plan} = parts;
  const updatePanel = seldom(150, () => parts.panels.get(parts.tabs.chosen)?.update()),
    describe = seldom(1000, () => parts.planTools.describe());
  session.on("time", () => {
    plan.surface.invalidate();
    timeline.moveCursor();
    if (!axis.whole) axis.reveal(session.time);
    updatePanel();
    describe();
  });
  session.on("layers robot", parts.repaintPlans);
  session.on("robot event line run log source", updatePanel);
  session.on("event", () => {
    timeline.scrolled();
    if (session.event && !["tasks", "finding"].includes(parts.tabs.chosen)) parts.tabs.choose("event");
  });
  session.on("theme", () => {
    for (const surface of surfaces) surface.invalidate();
    drawLegend();
  });
  session.on("run source", () => showFacts(session));
  parts.tabs.listeners.push(updatePanel, (key) => key === "lines" && parts.panels.get("lines").form.showFields());
  axis.listeners.push(() => {
    timeline.viewChanged();
    setText(byId("view-text"), `${spanText(axis.span)} in view`);
  });
  byId("show-all").addEventListener("click", () => axis.showAll());
  byId("show-cursor").addEventListener("click", () => showCursor(session, axis));
  byId("lane-filter").addEventListener("input", (event) => {
    timeline.rows.wanted = event.target.value;
    timeline.rows.layOut();
    timeline.layOut();
  });
  byId("theme").addEventListener("click", () => toggleTheme(session));
  theme.system.addEventListener("change", () => chooseTheme(session, theme.chosen));
  parts.keyboard = new Keyboard(session, clock, pageActions(session, parts));
  connectSource(session, clock, parts);
  showFacts(session);
}

/** The task's event at the cursor, or its last before it. */
function selectTask(session, parts, {name, robot, number}) {
  const {store} = parts.timeline.data,
    task = store?.byKey.get(`${robot}/${name}/${number}`);
  if (task === undefined || store.lanes[task].length === 0) return;
  const lane = store.lanes[task],
    next = firstWhere(lane.length, (i) => lane[i] > session.frame.events - store.first);
  parts.timelineGestures.select(lane[Math.max(0, next - 1)]);
  parts.timeline.reveal(session.event.key);
  parts.axis.reveal(session.event.time);
}

function pageActions(session, parts) {
  const {plan, planTools, axis} = parts;
  const zoom = (factor) => {
    plan.camera.fitted = false;
    plan.camera.zoom(factor, plan.camera.width / 2, plan.camera.height / 2);
    parts.repaintPlans();
  };
  return {
    tab: (index) => parts.tabs.tabs[index] && parts.tabs.choose(parts.tabs.tabs[index].key),
    time: () => byId("time").select(),
    follow: () => planTools.toggleFollow(),
    layers: () => planTools.toggleMenu(),
    measure: () => planTools.toggleMeasure(),
    oblique: () => planTools.toggleOblique(),
    theme: () => toggleTheme(session),
    branch: () => {
      parts.tabs.choose("lines");
      parts.panels.get("lines").form.lines.focus();
    },
    cursor: () => showCursor(session, axis),
    fit: () => plan.fit(),
    zoomIn: () => zoom(1.25),
    zoomOut: () => zoom(0.8),
    escape: () => (planTools.measuring ? planTools.toggleMeasure(false) : planTools.toggleMenu(false))
  };
}

/** Ten milliseconds about the cursor, or a tenth of the visible span if that is less. */
function showCursor(session, axis) {
  const span = Math.min(10 * MILLISECOND, axis.span <= 11 * MILLISECOND ? axis.span / 10 : Infinity);
  axis.set(session.time - span / 2, session.time + span / 2);
}

function chooseTheme(session, chosen) {
  theme.choose(chosen);
  byId("theme").setAttribute("aria-pressed", String(theme.dark));
  session.changed("theme");
}

const toggleTheme = (session) => chooseTheme(session, theme.dark ? "light" : "dark");

function drawLegend() {
  byId("legend").replaceChildren(
    ...Object.entries(STATES).map(([key, state]) => {
      const canvas = element("canvas", {width: 22, height: 11, "aria-hidden": "true"}),
        pen = canvas.getContext("2d");
      pen.fillStyle = key === "idle" ? theme.colours.idle : stateFill(pen, key);
      pen.fillRect(0, key === "idle" ? 5 : 0, 22, key === "idle" ? 2 : 11);
      return element("li", {}, canvas, state.name);
    })
  );
}

/** For tests: the page's state, and where things are on the canvases. */
function testHook(session, clock, parts) {
  const {camera, axis} = parts;
  return {
    session,
    clock,
    parts,
    pictures,
    theme,
    pixels: (x, y, z = 0) => ({x: camera.across(x, y), y: camera.down(x, y, z)}),
    timePixels: (time) => axis.x(time),
    paint: () => paintSurfaces()
  };
}
