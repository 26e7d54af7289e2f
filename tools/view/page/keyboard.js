// SPDX-License-Identifier: BSD-3-Clause
// Keys of the whole page, and the dialog that lists them.

const KEYS = [
  [
    "Time",
    [
      ["Space", "play, pause"],
      ["←  →", "back, on by a period"],
      ["Shift ←  →", "back, on by an event"],
      [",  .", "back, on by an event of the selected task"],
      ["Page ↑  ↓", "back, on by a second"],
      ["Home  End", "begin, end of the run"],
      ["[  ]", "slower, faster"],
      ["g", "follow the run as it goes"],
      ["t", "type an instant: 34.4, +0.5, 12 ms, 1:02:03"],
      ["b", "branch here"]
    ]
  ],
  [
    "Plan",
    [
      ["f", "follow the robot"],
      ["n  N", "next, previous robot"],
      ["l", "layers"],
      ["m", "measure: drag from a place to another"],
      ["v", "oblique view; Shift or right button and drag turn it"],
      ["+  −  0", "zoom, show all"],
      ["Shift click", "a place for a branch's intervention"],
      ["drag, wheel", "pan, zoom; double click on a robot follows it"]
    ]
  ],
  [
    "Timeline",
    [
      ["wheel", "zoom about the pointer; with Shift along"],
      ["click", "select an event; double click goes to it"],
      ["←  →  ↑  ↓", "with focus: events of the task, other tasks"],
      ["Enter", "with focus: go to the selected event"],
      ["c", "ten milliseconds about the cursor"]
    ]
  ],
  [
    "Page",
    [
      ["1 – 7", "tabs of details"],
      ["d", "light, dark"],
      ["?", "this list"],
      ["Esc", "close, end measuring"]
    ]
  ]
];

class Keyboard {
  /** actions: functions by name, for keys that do not move the time. */
  constructor(session, clock, actions) {
    Object.assign(this, {session, clock, actions});
    addEventListener("keydown", (event) => this.key(event));
    const close = element("button", {class: "primary", onclick: () => this.dialog.close()}, "Close");
    this.dialog = byId("help-dialog");
    this.dialog.append(
      element("h2", {id: "help-title"}, "Keys and gestures"),
      element(
        "div",
        {class: "columns"},
        KEYS.map(([name, keys]) =>
          element(
            "div",
            {},
            element("h3", {}, name),
            element(
              "dl",
              {},
              keys.flatMap(([key, text]) => [
                element(
                  "dt",
                  {},
                  key.split("  ").flatMap((one, i) => [i ? " " : "", element("kbd", {}, one)])
                ),
                element("dd", {}, text)
              ])
            )
          )
        )
      ),
      element("div", {class: "buttons"}, close)
    );
    byId("help").addEventListener("click", () => this.dialog.showModal());
  }

  key(event) {
    const target = event.target,
      typing = target.matches("input:not([type=range]):not([type=checkbox]), select, textarea");
    if (typing || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    // A button's own keys remain its own.
    if ((event.key === " " || event.key === "Enter") && target.matches("button, summary, input[type=checkbox]")) return;
    const action = this.actionOf(event);
    if (!action) return;
    event.preventDefault();
    action();
  }

  actionOf(event) {
    const {clock, session, actions} = this,
      task = session.event?.taskNumber ?? null;
    if (/^[1-9]$/.test(event.key)) return () => actions.tab(Number(event.key) - 1);
    switch (event.key) {
      case " ":
        return () => clock.toggle();
      case "ArrowLeft":
        return () => (event.shiftKey ? clock.step(-1) : clock.stepPeriod(-1));
      case "ArrowRight":
        return () => (event.shiftKey ? clock.step(1) : clock.stepPeriod(1));
      case ",":
        return () => clock.step(-1, task);
      case ".":
        return () => clock.step(1, task);
      case "PageUp":
        return () => clock.stepPeriod(-1, SECOND);
      case "PageDown":
        return () => clock.stepPeriod(1, SECOND);
      case "Home":
        return () => clock.seek(0);
      case "End":
        return () => clock.seek(clock.end);
      case "[":
        return () => clock.setSpeed(clock.speed / 2);
      case "]":
        return () => clock.setSpeed(clock.speed * 2);
      case "g":
        return () => clock.toggleLive();
      case "?":
        return () => this.dialog.showModal();
      case "n":
        return () => session.selectRobot((session.robot + 1) % Math.max(1, session.header.robots.length));
      case "N":
        return () =>
          session.selectRobot(
            (session.robot + session.header.robots.length - 1) % Math.max(1, session.header.robots.length)
          );
      default:
        return actions[
          {
            t: "time",
            f: "follow",
            l: "layers",
            m: "measure",
            v: "oblique",
            d: "theme",
            b: "branch",
            c: "cursor",
            0: "fit",
            "+": "zoomIn",
            "=": "zoomIn",
            "-": "zoomOut",
            Escape: "escape"
          }[event.key]
        ];
    }
  }
}
