// SPDX-License-Identifier: BSD-3-Clause
// Elements of the document. Texts of a run reach it as text nodes and attributes only, never as markup.

/**
 * element("button", {class: "flat", "aria-label": "Play", onclick: f}, "text", child, ...); null properties and
 * children are left out.
 */
function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  setProperties(made, properties);
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
}

function setProperties(target, properties) {
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) target.addEventListener(name.slice(2), value, {passive: false});
    else target.setAttribute(name, value === true ? "" : String(value));
  }
}

const byId = (id) => document.getElementById(id);

/** Replaces an element's text only if it differs: screen readers do not hear it again, and nothing is laid out anew. */
function setText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

/** A table whose rows are made once and whose cells' texts are then kept current. */
class TextTable {
  constructor(caption, columns) {
    this.body = element("tbody");
    this.table = element(
      "table",
      {},
      element("caption", {}, caption),
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          columns.map((name) => element("th", {scope: "col"}, name))
        )
      ),
      this.body
    );
    this.rows = [];
  }

  /** rows: lists of texts; the first cell of each is its heading. choose: called with a row's index on a click. */
  set(rows, {marked = -1, choose = null} = {}) {
    while (this.rows.length > rows.length) this.rows.pop().remove();
    rows.forEach((texts, index) => {
      let row = this.rows[index];
      if (!row) {
        const heading = choose ? element("button", {class: "link", onclick: () => choose(index)}) : element("span");
        row = element(
          "tr",
          {},
          element("th", {scope: "row"}, heading),
          texts.slice(1).map(() => element("td"))
        );
        this.rows.push(row);
        this.body.append(row);
      }
      setText(row.firstChild.firstChild, texts[0]);
      for (let i = 1; i < texts.length; ++i) setText(row.children[i], texts[i]);
      row.classList.toggle("marked", index === marked);
    });
  }
}
