// SPDX-License-Identifier: BSD-3-Clause
// A finding of the explorer at a glance: the failure, the two events whose order matters in the failing and in the
// passing schedule with their call stacks, and the commands that repeat it.

const PAIR = ["A", "B"]; // the event that comes first in the failing schedule, and that first in the passing one

class FindingPanel {
  constructor(panel, session, axis) {
    Object.assign(this, {panel, session, axis});
    const {finding} = session.source;
    if (!finding) return;
    const [headline, ...lines] = finding.failure.trim().split("\n");
    panel.append(
      element("h2", {}, "Failure"),
      element("p", {class: "headline"}, headline),
      ...(lines.length ? [element("pre", {}, lines.join("\n"))] : []),
      element("p", {class: "note"}, finding.schedule),
      element("h2", {}, "The two events whose order matters"),
      ...this.pair(),
      element("h2", {}, "Repeat it"),
      command("replay", finding.replay),
      finding.debug ? command("gdb", finding.debug) : "",
      ...more("Steps of the tasks", finding.steps),
      ...more("The whole report", finding.report)
    );
  }

  update() {}

  pair() {
    const {source} = this.session,
      {choice, note: reason} = source.finding,
      all = source.lines.flatMap((_, line) => source.marks(line)),
      note = (text) => element("p", {class: "note"}, text);
    const last = choice ? [note(`The last choice from which it could still have passed: ${choice}`)] : [];
    if (all.length === 0 || source.lines.length < 2) return [note(`None: ${reason.trim()}.`), ...last];
    return [
      element("div", {class: "schedules"}, this.card(0, "Fails"), this.card(1, "Passes")),
      ...last,
      note("In the timelines below, events of one instant are a nanosecond apart.")
    ];
  }

  /** The events of the pair in one schedule, in their order there. */
  card(line, name) {
    const {source} = this.session,
      marks = source.marks(line).sort((one, other) => one.number - other.number),
      absent = PAIR.filter((_, pair) => !marks.some((mark) => mark.pair === pair));
    return element(
      "section",
      {class: line === 0 ? "bad" : "good", "aria-label": `${name}: the events`},
      element("h3", {}, `${name}: ${marks.map(({pair}) => PAIR[pair]).join(" before ")}`),
      element("ol", {class: "pair"}, marks.map((mark) => this.event(mark))),
      absent.map((letter) => element("p", {class: "note"}, `${letter} does not happen.`))
    );
  }

  event(mark) {
    const choose = () => {
      this.axis.reveal(mark.time);
      this.session.selectEvent(mark);
    };
    return element(
      "li",
      {},
      element("span", {class: `badge pair-${mark.pair}`, "aria-hidden": "true"}, PAIR[mark.pair]),
      element("button", {class: "link", onclick: choose}, `${mark.task} of ${mark.robot}: ${mark.operation} ${mark.object}`),
      element("span", {class: "age"}, ` at ${shortInstantText(mark.instant)}`),
      element("ol", {class: "stack"}, (mark.frames ?? []).map(stackRow))
    );
  }
}

/** A command with a button that copies it, or at least selects it. */
function command(name, text) {
  const line = element("pre", {class: "command"}, text);
  const copy = element("button", {"aria-label": `Copy the command: ${name}`}, "Copy");
  copy.addEventListener("click", () => {
    getSelection().selectAllChildren(line);
    setText(copy, document.execCommand("copy") ? "Copied" : "Selected");
    setTimeout(() => setText(copy, "Copy"), 2000);
  });
  return element("div", {class: "row"}, element("span", {class: "age"}, name), copy, line);
}

function more(title, text) {
  if (!text) return [];
  return [element("details", {}, element("summary", {}, title), element("pre", {}, text))];
}

/** A finding begins with its schedules side by side, about the events whose order matters. */
async function showFinding(source, parts, clock) {
  parts.tabs.choose(source.finding ? "finding" : "lines");
  if (source.lines.length > 1) await parts.panels.get("lines").compare(1);
  const marks = source.lines.flatMap((_, line) => source.marks(line)),
    shown = marks.length ? source.lines : source.lines.slice(0, 1),
    spans = shown.map(({store}, line) => spanAbout(store, marks.filter((mark) => mark.line === line)));
  parts.axis.set(Math.min(...spans.map(({from}) => from)), Math.max(...spans.map(({to}) => to)));
  // Just before the first of them, which the cursor would cover.
  await clock.seek(Math.min(...marks.map(({time}) => time - 1), source.status.time));
}

/** The span of the marked events of a schedule with some before and after them; without any, of the last ones. */
function spanAbout(store, marks) {
  const margin = 24,
    last = store.count - 1,
    places = marks.length ? marks.map(({number}) => number - store.first) : [last];
  if (last < 0) return {from: 0, to: LEAST_SPAN};
  const from = store.time[Math.max(0, Math.min(...places) - margin)],
    to = store.time[Math.min(last, Math.max(...places) + margin)];
  return {from: from - 0.03 * (to - from) - 1, to: to + 0.06 * (to - from) + 2};
}
