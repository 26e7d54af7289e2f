// SPDX-License-Identifier: BSD-3-Clause
// Lines of time: the run and its branches, which of them is shown, which one beside it, and where the two begin to
// differ.

/** The results of a journal's interventions. */
function outcomesOf({outcomes = []}) {
  if (outcomes.length === 0) return [];
  return [
    element("p", {class: "note"}, "What came of it:"),
    element("ul", {}, ...outcomes.map(({time, text}) => element("li", {}, `${shortInstantText(time)} ${text}`)))
  ];
}

class LinesPanel {
  constructor(panel, session, clock, axis) {
    Object.assign(this, {session, clock, axis});
    this.list = element("ul", {class: "lines"});
    this.difference = element("div", {class: "difference"});
    this.journal = element("div");
    panel.append(element("h2", {}, "Lines of time"), this.list, this.difference, this.journal);
    this.form = new BranchForm(panel, session, (line) => clock.setLine(line));
    session.on("run line compare", () => this.update());
  }

  update() {
    const {session} = this,
      {lines} = session.source.status,
      key = JSON.stringify([
        lines.map(({to, ...line}) => line),
        session.line,
        session.compared?.line,
        session.compared?.difference
      ]);
    this.form.update();
    lines.forEach(
      (line, i) => this.list.children[i]?.lastChild && setText(this.list.children[i].lastChild, this.rangeText(line))
    );
    if (key === this.shown) return;
    this.shown = key;
    this.list.replaceChildren(...lines.map((line) => this.row(line)));
    this.showDifference();
  }

  rangeText(line) {
    return `${line.parent === null ? "from the beginning" : `from line ${line.parent} at ${shortInstantText(line.from)}`}, to ${shortInstantText(line.to)}`;
  }

  row(line) {
    const {session} = this,
      shown = line.line === session.line,
      beside = line.line === session.compared?.line;
    const button = (text, pressed, action, more = {}) =>
      element("button", {"aria-pressed": String(pressed), onclick: action, ...more}, text);
    return element(
      "li",
      {class: shown ? "marked" : ""},
      element("strong", {}, `${line.line}: ${line.name}`),
      element(
        "span",
        {class: "row"},
        button("Show", shown, () => this.clock.setLine(line.line), {"aria-label": `Show line ${line.line}`}),
        shown
          ? null
          : button("Beside", beside, () => this.compare(beside ? null : line.line), {
              "aria-label": `Line ${line.line} beside`
            }),
        session.source.journal
          ? element(
              "button",
              {"aria-label": `Journal of line ${line.line}`, onclick: () => this.showJournal(line.line)},
              "Journal"
            )
          : null
      ),
      element("span", {class: "age"}, this.rangeText(line))
    );
  }

  /** Shows a line beside this one, or none. */
  async compare(line) {
    const {session} = this;
    session.compared = line === null ? null : {line, frame: null, difference: null};
    session.changed("beside");
    session.changed("compare");
    if (line === null) return;
    await this.clock.seek(session.time);
    const difference = await session.source.compare(session.line, line).catch((error) => ({error: error.message}));
    if (session.compared?.line !== line) return;
    session.compared.difference = difference;
    session.changed("beside");
    session.changed("compare");
  }

  showDifference() {
    const {compared} = this.session;
    this.difference.replaceChildren(
      ...this.marked(),
      ...(compared ? [element("h2", {}, "First event that differs"), this.found(compared)] : [])
    );
  }

  found({line, difference}) {
    if (!difference?.event) {
      const text = !difference ? "…" : (difference.error ?? "None so far.");
      return element("p", {class: "note"}, text);
    }
    const {event, time, a, b} = difference,
      fact = (name, text) => [element("dt", {}, `line ${name}`), element("dd", {}, text || "no event")],
      go = element("button", {onclick: () => this.clock.goTo({time, number: event})}, "Go there");
    return element(
      "div",
      {},
      element("p", {}, `Event ${countText(event)} at ${instantText(time)} `, go),
      element("dl", {class: "facts"}, fact(this.session.line, a), fact(line, b))
    );
  }

  /** A finding's events of interest, in all lines. */
  marked() {
    const {session} = this,
      {source} = session,
      marks = source.status.lines.flatMap(({line}) => source.marks?.(line) ?? []);
    if (marks.length === 0) return [];
    const row = (mark) => {
      const choose = () => {
        this.axis.reveal(mark.time);
        session.selectEvent(mark);
      };
      const text = `line ${mark.line}, ${mark.task} ${mark.operation} ${mark.object}: ${mark.text}`;
      return element("li", {}, element("button", {class: "link", onclick: choose}, text));
    };
    return [element("h2", {}, "Events whose order matters"), element("ul", {class: "lines"}, marks.map(row))];
  }

  async showJournal(line) {
    const answer = await this.session.source.journal(line).catch((error) => ({text: error.message, command: ""}));
    this.journal.replaceChildren(
      element("h2", {}, `Journal of line ${line}, up to the cursor`),
      element("pre", {}, answer.text),
      ...outcomesOf(answer),
      element("p", {class: "note"}, answer.command ? "Repeated by:" : ""),
      element("pre", {}, answer.command ?? "")
    );
  }
}
