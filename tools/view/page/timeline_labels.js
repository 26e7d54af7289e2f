// SPDX-License-Identifier: BSD-3-Clause
// The names of the timeline's rows, with buttons that close and open groups.

class TimelineLabels {
  constructor(view) {
    this.view = view;
    this.root = element("div", {class: "lane-labels"});
    this.shown = "";
  }

  /**
   * Labels of the rows in view only: a thousand robots have many. Rows are made anew if they are others than before.
   */
  update() {
    const {view} = this,
      {rows, session} = view,
      visible = rows.visible(view.top, view.surface.height - RULER);
    const key =
      `${rows.rows.length} ${session.event?.key} ` +
      visible.map((row) => `${row.key ?? row.tasks[0].key} ${row.closed}`).join();
    this.root.style.top = `${RULER - view.top}px`;
    if (key === this.shown && this.root.childElementCount === visible.length) return;
    this.shown = key;
    const focused = document.activeElement?.dataset?.group;
    this.root.replaceChildren(...visible.map((row) => this.labelOf(row)));
    if (focused) this.root.querySelector(`[data-group="${CSS.escape(focused)}"]`)?.focus();
  }

  labelOf(row) {
    const name = row.kind === "robot" ? row.label : row.module;
    const toggle = () => {
      this.view.rows.toggle(row.key);
      this.view.layOut();
    };
    const button =
      row.key && name
        ? element(
            "button",
            {
              class: "lane-group",
              "data-group": row.key,
              "aria-expanded": String(!row.closed),
              onclick: toggle,
              title: `${row.closed ? "Open" : "Close"} ${name}`
            },
            element("span", {class: "chevron", "aria-hidden": "true"}, row.closed ? "▸" : "▾"),
            name
          )
        : null;
    const chosen = row.tasks.length === 1 && row.tasks[0].key === this.view.session.event?.key;
    const label = element(
      "div",
      {class: `lane-label ${row.kind}${row.odd ? " odd" : ""}${chosen ? " chosen" : ""}`},
      button,
      row.kind === "robot" ? null : element("span", {class: "lane-name"}, row.label)
    );
    label.style.top = `${row.y}px`;
    label.style.height = `${row.height}px`;
    return label;
  }
}
