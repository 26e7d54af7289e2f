// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together.

function liveAddress() {
  const url = new URL("live", location.href);
  url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  url.search = new URLSearchParams({token: new URLSearchParams(location.search).get("token") ?? ""}).toString();
  return url.href;
}

async function openSource() {
  const run = byId("run");
  if (run) {
    const data = await unpacked(run.textContent);
    return data.search ? new SearchView(data.search) : new RecordedSource(data);
  }
  setText(byId("connection"), "connecting …");
  return LiveSource.open(liveAddress());
}

/** A line for the user; it stays for a while, or until the next. */
function report(text) {
  setText(byId("message"), text);
  clearTimeout(report.timer);
  report.timer = setTimeout(() => setText(byId("message"), ""), 8000);
}

async function start() {
  theme.choose("auto");
  const source = await openSource();
  if (source instanceof SearchView) {
    document.documentElement.dataset.ready = "true";
    return;
  }
  const session = new Session(source),
    clock = new Clock(session, report);
  const {header} = source;
  document.title = `${header.scenario} – waitpoint`;
  setText(byId("scenario"), header.scenario);
  const parts = buildParts(session, clock);
  connectParts(session, clock, parts);
  await clock.seek(0);
  parts.axis.showAll();
  if (source.kind === "live") await clock.followRun();
  else if (source.finding || source.lines.length > 1) await showFinding(source, parts, clock);
  // Programs without robots have no floor.
  byId("plots").hidden = Boolean(source.finding);
  byId("plan").hidden = byId("split-side").hidden = header.robots.length + header.obstacles.length === 0;
  window.waitpoint = testHook(session, clock, parts);
  document.documentElement.dataset.ready = "true";
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
      ? source.finding
        ? "finding"
        : "recorded run"
      : source.connection.state === "open"
        ? status.over
          ? "connected, run over"
          : "connected"
        : "connection lost, trying again …";
  setText(byId("connection"), state);
  byId("connection").className = source.kind === "recorded" ? "" : source.connection.state === "open" ? "good" : "bad";
}

start().catch((error) => report(`The page cannot show this run: ${error.message}`));
