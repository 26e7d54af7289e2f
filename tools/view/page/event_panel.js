// SPDX-License-Identifier: BSD-3-Clause
// The selected event, with the event that woke its task, its neighbours, and its lines of source.

class EventPanel {
  constructor(panel, session, clock, gestures) {
    Object.assign(this, {session, clock, gestures});
    this.shown = undefined;
    this.facts = element("dl", {class: "facts"});
    this.stack = element("ol", {class: "stack"});
    this.note = element("p", {class: "note"});
    const button = (text, action, title) => element("button", {onclick: action, title}, text);
    this.buttons = element(
      "div",
      {class: "row"},
      button("Go there", () => clock.goTo(session.event), "Enter, or a double click in the timeline"),
      button("◂ of this task", () => gestures().selectBeside(-1)),
      button("of this task ▸", () => gestures().selectBeside(1))
    );
    panel.append(
      element("h2", {}, "Event"),
      this.note,
      this.facts,
      this.buttons,
      element("h2", {}, "Source"),
      this.stack
    );
    const load = seldom(150, () => this.load());
    session.on("event", () => {
      this.update();
      load();
    });
  }

  update() {
    const {event} = this.session;
    if (event === this.shown) return;
    this.shown = event;
    this.buttons.hidden = this.facts.hidden = !event;
    setText(this.note, event ? "" : "Click an event in the timeline, or step: Shift and an arrow.");
    if (!event) return this.stack.replaceChildren();
    const facts = [
      ["Event", countText(event.number)],
      ["Time", instantText(event.instant ?? event.time)],
      ["Task", `${event.task} of ${event.robot}`],
      ["Operation", event.operation],
      ["Object", event.object || "–"]
    ];
    if (event.isSwitch) facts.push(["Switch", "chosen over the default order's event"]);
    if (event.waker)
      facts.push([
        "Woken by",
        element(
          "button",
          {
            class: "link",
            onclick: () => this.gestures().select(event.waker.number - this.gestures().view.data.store.first)
          },
          `${event.waker.task}: ${event.waker.operation}, event ${countText(event.waker.number)}`
        )
      ]);
    this.facts.replaceChildren(
      ...facts.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])
    );
    setText(
      byId("event-text"),
      `Event ${event.number}: ${event.task} of ${event.robot}, ${event.operation} ${event.object}, at ${instantText(event.time)}`
    );
  }

  /** The call stack at the event, if the source can tell it: the run is repeated up to there for that. */
  async load() {
    const {event, source, line} = this.session;
    if (!event) return;
    this.stack.replaceChildren(element("li", {class: "note"}, "…"));
    const answer = await source.stack(event.line ?? line, event.number).catch((error) => ({error: error.message}));
    if (event !== this.session.event) return;
    this.stack.replaceChildren(
      ...(answer.error
        ? [element("li", {class: "note"}, answer.error)]
        : answer.frames.map(stackRow))
    );
  }
}

/** A call of a stack. */
const stackRow = (frame) =>
  element(
    "li",
    {},
    element("span", {class: "function"}, frame.function),
    " ",
    element("span", {class: "place"}, frame.file ? `${frame.file}:${frame.line}` : "")
  );
