// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together.

async function openSource() {
  const run = byId("run");
  if (run) return RecordedSource.open(run.textContent);
  const url = new URL("live", location.href);
  url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  url.search = new URLSearchParams({token: new URLSearchParams(location.search).get("token") ?? ""}).toString();
  setText(byId("connection"), "connecting …");
  return LiveSource.open(url.href);
}

/** A line for the user; it stays for a while, or until the next. */
function report(text) {
  setText(byId("message"), text);
  clearTimeout(report.timer);
  report.timer = setTimeout(() => setText(byId("message"), ""), 8000);
}

async function start() {
  theme.choose("auto");
  const source = await openSource(),
    session = new Session(source),
    clock = new Clock(session, report);
  const {header} = source;
  document.title = `${header.scenario} – waitpoint`;
  setText(byId("scenario"), header.scenario);
  const parts = buildParts(session, clock);
  connectParts(session, clock, parts);
  await clock.seek(0);
  parts.axis.showAll();
  if (source.kind === "live") clock.setLive(true);
  else if (source.lines.length > 1) await showFinding(source, parts);
  // Programs without robots have no floor.
  byId("plan").hidden = byId("split-side").hidden = header.robots.length + header.obstacles.length === 0;
  window.waitpoint = testHook(session, clock, parts);
  document.documentElement.dataset.ready = "true";
}

/** A finding begins with its lines side by side, about the events whose order matters. */
async function showFinding(source, parts) {
  parts.tabs.choose("lines");
  await parts.panels.get("lines").compare(1);
  const times = source.lines.flatMap((_, line) => source.marks(line).map(({time}) => time)),
    margin = Math.max(extent(times), MILLISECOND);
  if (times.length) parts.axis.set(Math.min(...times) - margin, Math.max(...times) + margin);
}

function showFacts(session) {
  const {header, source} = session,
    {status} = source;
  setText(
    byId("facts"),
    [
      `seed ${header.seed}`,
      `order ${header.order}`,
      status.over ? status.outcome || "finished" : "running",
      status.over ? status.digest : "",
      header.program
    ]
      .filter(Boolean)
      .join(" · ")
  );
  const state =
    source.kind === "recorded"
      ? "recorded run"
      : source.connection.state === "open"
        ? status.over
          ? "connected, run over"
          : "connected"
        : "connection lost, trying again …";
  setText(byId("connection"), state);
  byId("connection").className = source.kind === "recorded" ? "" : source.connection.state === "open" ? "good" : "bad";
}

start().catch((error) => report(`The page cannot show this run: ${error.message}`));
