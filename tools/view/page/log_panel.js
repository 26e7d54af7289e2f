// SPDX-License-Identifier: BSD-3-Clause
// Requests and their outcomes, and other messages of the run, about the cursor.

class LogPanel {
  constructor(panel, session, clock) {
    this.session = session;
    this.clock = clock;
    this.words = element("input", {
      type: "search",
      placeholder: "Filter",
      "aria-label": "Only lines with these words",
      oninput: () => this.update()
    });
    this.bad = element("input", {type: "checkbox", onchange: () => this.update()});
    this.list = element("ol", {class: "log"});
    this.shown = "";
    panel.append(
      element("div", {class: "row"}, this.words, element("label", {}, this.bad, " problems only")),
      this.list
    );
  }

  /** The lines of the shown line of time: a branch has those of the run up to its beginning. */
  known() {
    const {session} = this,
      {log} = session.source,
      lines = session.source.status.lines ?? [];
    let line = lines[session.line];
    while (line && line.parent > 0) line = lines[line.parent];
    return line && line.parent === 0 ? log.filter(([time]) => time <= line.from) : log;
  }

  update() {
    const {session} = this,
      log = this.known(),
      words = this.words.value.toLowerCase();
    const robot = (index) => (index >= 0 ? (session.header.robots[index]?.name ?? "") : "");
    const lines = log.filter(
      (line) =>
        (!this.bad.checked || line[4]) &&
        (!words || `${robot(line[1])} ${line[2]} ${line[3]}`.toLowerCase().includes(words))
    );
    // Those up to the cursor and some after it, for long runs have many.
    const now = firstWhere(lines.length, (i) => lines[i][0] > session.time),
      first = Math.max(0, now - 250),
      end = Math.min(lines.length, now + 60);
    const shown = `${session.line} ${first} ${end} ${now} ${words} ${this.bad.checked} ${lines.length}`;
    if (shown === this.shown) return;
    this.shown = shown;
    const many = session.header.robots.length > 1;
    this.list.replaceChildren(
      ...lines
        .slice(first, end)
        .map(([time, index, module, text, bad], i) =>
          element(
            "li",
            {class: `${bad ? "bad" : ""}${first + i >= now ? " later" : ""}`},
            element("button", {class: "link", onclick: () => this.clock.seek(time)}, shortInstantText(time)),
            ` ${bad ? "⚠ " : ""}${many && index >= 0 ? `${robot(index)} ` : ""}${module ? `${module}: ` : ""}${text}`
          )
        )
    );
    if (lines.length === 0) this.list.append(element("li", {class: "note"}, "Nothing."));
    if (session.line > 0)
      this.list.append(element("li", {class: "note"}, "A branch has no log of its own; its journal says what came of it."));
    this.list.children[Math.max(0, now - first - 1)]?.scrollIntoView({block: "nearest"});
  }
}
