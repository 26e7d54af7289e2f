// SPDX-License-Identifier: BSD-3-Clause
// Tabs of the panel at the side, and the borders between the parts of the page, which pointers and arrow keys move.

class Tabs {
  constructor(list, panels) {
    this.list = list;
    this.panels = panels;
    this.tabs = [];
    this.listeners = [];
    list.addEventListener("keydown", (event) => this.key(event));
  }

  add(key, name) {
    const panel = element("div", {
      class: "panel",
      role: "tabpanel",
      id: `panel-${key}`,
      "aria-labelledby": `tab-${key}`,
      tabindex: 0,
      hidden: true
    });
    const tab = element(
      "button",
      {
        role: "tab",
        id: `tab-${key}`,
        "aria-controls": `panel-${key}`,
        "aria-selected": "false",
        tabindex: -1,
        onclick: () => this.choose(key)
      },
      name
    );
    this.tabs.push({key, tab, panel});
    this.list.append(tab);
    this.panels.append(panel);
    if (this.tabs.length === 1) this.choose(key);
    return panel;
  }

  choose(key) {
    this.chosen = key;
    for (const one of this.tabs) {
      const chosen = one.key === key;
      one.tab.setAttribute("aria-selected", String(chosen));
      one.tab.tabIndex = chosen ? 0 : -1;
      one.panel.hidden = !chosen;
    }
    for (const listener of this.listeners) listener(key);
  }

  key(event) {
    const move = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (!move) return;
    const at = this.tabs.findIndex((one) => one.key === this.chosen),
      next = this.tabs[(at + move + this.tabs.length) % this.tabs.length];
    this.choose(next.key);
    next.tab.focus();
    event.preventDefault();
    event.stopPropagation();
  }
}

/** A border that sets the size of the part behind it. */
function makeSplitter(splitter, part, least = 60) {
  const upright = splitter.getAttribute("aria-orientation") === "vertical",
    side = upright ? "width" : "height";
  const size = () => part.getBoundingClientRect()[side];
  const set = (wanted) => {
    const most = splitter.parentElement.getBoundingClientRect()[side] * 0.85,
      value = Math.round(Math.max(least, Math.min(wanted, most)));
    part.style[side] = `${value}px`;
    splitter.setAttribute("aria-valuemin", least);
    splitter.setAttribute("aria-valuemax", Math.round(most));
    splitter.setAttribute("aria-valuenow", value);
  };
  let drag = null;
  splitter.addEventListener("pointerdown", (event) => {
    drag = {at: upright ? event.clientX : event.clientY, size: size()};
    splitter.setPointerCapture(event.pointerId);
  });
  splitter.addEventListener(
    "pointermove",
    (event) => drag && set(drag.size + drag.at - (upright ? event.clientX : event.clientY))
  );
  for (const name of ["pointerup", "pointercancel"]) splitter.addEventListener(name, () => (drag = null));
  splitter.addEventListener("keydown", (event) => {
    const move = {[upright ? "ArrowLeft" : "ArrowUp"]: 24, [upright ? "ArrowRight" : "ArrowDown"]: -24}[event.key];
    if (!move) return;
    set(size() + move);
    event.preventDefault();
    event.stopPropagation();
  });
  set(size());
}
