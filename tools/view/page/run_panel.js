// SPDX-License-Identifier: BSD-3-Clause
// The run itself: how far it is, its summary, and, if the program allows it, its pace.

const PACES = [
  [0, "as fast as it computes"],
  [0.1, "0.1×"],
  [0.5, "0.5×"],
  [1, "1×"],
  [2, "2×"],
  [10, "10×"],
  [100, "100×"]
];

class RunPanel {
  constructor(panel, session, report, counts) {
    Object.assign(this, {session, counts});
    const {source} = session,
      told = (promise) => promise.catch((error) => report(error.message));
    this.hold = element(
      "button",
      {"aria-pressed": "false", onclick: () => told(source.pause(!source.status.paused))},
      "Hold the run"
    );
    this.pace = element(
      "select",
      {onchange: (event) => told(source.pace(Number(event.target.value)))},
      PACES.map(([value, name]) => element("option", {value}, name))
    );
    this.controls = element("div", {class: "row"}, this.hold, element("label", {}, "Pace ", this.pace));
    this.facts = new TextTable("Run", ["Fact", "Value"]);
    this.text = element("pre");
    this.whose = element("h2", {}, "Summary");
    panel.append(this.facts.table, this.controls, this.whose, this.text);
  }

  update() {
    const {source, header} = this.session,
      {status} = source;
    this.controls.hidden = !source.control || status.over;
    this.hold.setAttribute("aria-pressed", String(status.paused === true));
    const rows = [
      ["Scenario", header.scenario],
      ["Seed, order", `${header.seed}, ${header.order}`],
      ["State", status.over ? status.outcome || "over" : status.paused ? "held" : "running"],
      ["Time", `${shortInstantText(status.time)} of at most ${shortInstantText(header.until)}`],
      ["Events", countText(status.events)],
      ["Robots", String(header.robots.length)]
    ];
    if (header.description) rows.splice(1, 0, ["Description", header.description]);
    if (this.collisions()) rows.push(["Collisions", this.collisions()]);
    if (this.missed()) rows.push(["Deadlines missed", this.missed()]);
    if (status.digest) rows.push(["Digest", status.digest]);
    this.facts.set(rows);
    setText(this.whose, this.session.line > 0 ? "Summary of the run, not of this line" : "Summary");
    setText(this.text, status.summary || (status.over ? "No summary." : "When the run is over."));
  }

  /** When robots have hit something, the first times. */
  collisions() {
    const {robots} = this.session.header,
      all = this.counts()?.collisions ?? [];
    const texts = all.slice(0, 8).map(([time, i]) => `${robots.length > 1 ? `${robots[i].name} ` : ""}${shortInstantText(time)}`);
    return texts.join(", ") + (all.length > texts.length ? ", ..." : "");
  }

  /** Deadlines that tasks have missed in the whole run, the most first. */
  missed() {
    const counts = this.counts(),
      several = this.session.header.robots.length > 1;
    const sums = (counts?.missed ?? []).map((row, i) => ({task: counts.tasks[i], sum: row.reduce((a, b) => a + b, 0)}));
    return sums
      .filter(({sum}) => sum > 0)
      .sort((one, other) => other.sum - one.sum)
      .slice(0, 8)
      .map(({task: [, name, robot], sum}) => `${several ? `${robot} ` : ""}${name} ${sum}`)
      .join(", ");
  }
}
