// SPDX-License-Identifier: BSD-3-Clause
// Plots below the timeline, on its axis: one a field.

class PlotsView {
  constructor(session, axis, clock) {
    Object.assign(this, {session, axis, clock});
    this.plots = [];
    this.host = byId("plot-list");
    this.fields = byId("plot-field");
    byId("plot-add").addEventListener("click", () => this.fields.value && this.add(JSON.parse(this.fields.value)));
    axis.listeners.push(() => {
      this.loadAll();
      this.repaint();
    });
    session.on("time", () => this.moveCursors());
    session.on("line", () => this.loadAll());
    session.on("robot", () => this.showFields());
    this.showFields();
    this.begin();
  }

  /**
   * A recorded run begins with the selected robot's speed, if that is there. A live one would have to be repeated for
   * it.
   */
  begin() {
    if (this.session.source.kind !== "recorded") return;
    const speed = this.session.source
      .plottable()
      .find((one) => one.robot === this.session.robot && /(^|\.)v_m_s$/.test(one.field));
    if (speed) this.add(speed);
  }

  showFields() {
    const {session} = this,
      groups = new Map();
    for (const one of session.source.plottable()) {
      if (one.robot !== session.robot) continue;
      if (!groups.has(one.poster)) groups.set(one.poster, []);
      groups.get(one.poster).push(one);
    }
    this.fields.replaceChildren(
      ...[...groups].map(([poster, fields]) =>
        element(
          "optgroup",
          {label: poster},
          fields.map((one) => element("option", {value: JSON.stringify(one)}, `${poster} ${one.field}`))
        )
      )
    );
    byId("plot-add").disabled = this.fields.disabled = groups.size === 0;
  }

  add(wanted) {
    if (this.plots.some((plot) => JSON.stringify(plot.series.wanted) === JSON.stringify(wanted))) return;
    const robot = this.session.header.robots[wanted.robot]?.name ?? "",
      title = `${this.session.header.robots.length > 1 ? `${robot} ` : ""}${wanted.poster}`;
    const plot = {
      series: new PlotSeries(wanted, title),
      value: element("output", {"aria-live": "off"}),
      cursor: element("div", {class: "cursor"}),
      hover: null,
      colour: this.freeColour()
    };
    const canvas = element("canvas", {role: "img", "aria-label": `${title} ${wanted.field} over time`}),
      remove = element(
        "button",
        {class: "flat", "aria-label": `Remove ${title} ${wanted.field}`, onclick: () => this.remove(plot)},
        "×"
      );
    plot.root = element(
      "div",
      {class: "plot"},
      element("div", {class: "host"}, canvas, plot.cursor),
      element(
        "div",
        {class: "name"},
        element("span", {class: "age"}, title),
        element("span", {class: "field", title: wanted.field}, wanted.field),
        plot.value,
        remove
      )
    );
    this.host.append(plot.root);
    this.plots.push(plot);
    plot.surface = new Surface(canvas, (pen, width, height) => this.paint(plot, pen, width, height));
    this.listen(plot, canvas);
    plot.load = seldom(120, () => this.loadOne(plot));
    plot.load();
    this.moveCursors();
  }

  loadAll() {
    for (const plot of this.plots) plot.load();
  }

  freeColour() {
    const used = new Set(this.plots.map((plot) => plot.colour));
    return [0, 1, 2, 3, 4, 5, 6, 7].find((colour) => !used.has(colour)) ?? this.plots.length % 8;
  }

  remove(plot) {
    plot.surface.close();
    plot.root.remove();
    this.plots.splice(this.plots.indexOf(plot), 1);
    byId("plot-add").focus();
  }

  async loadOne(plot) {
    const {axis} = this,
      margin = axis.span * 0.1;
    if (
      await plot.series.load(
        this.session.source,
        this.session.line,
        axis.from - margin,
        axis.to + margin,
        Math.ceil(axis.width * 2)
      )
    ) {
      plot.surface.invalidate();
      this.moveCursors();
    }
  }

  paint(plot, pen, width, height) {
    const {axis} = this,
      colours = theme.colours;
    pen.fillStyle = colours.floor;
    pen.fillRect(0, 0, width, height);
    pen.save();
    pen.beginPath();
    pen.rect(axis.left, 0, axis.width, height);
    pen.clip();
    axis.draw(pen, height, false);
    plot.series.draw(pen, axis, height, colours.robots[plot.colour]);
    pen.restore();
  }

  listen(plot, canvas) {
    const {axis, clock} = this,
      at = (event) => plot.surface.place(event).x;
    let drag = null;
    const hover = (x) => {
      plot.hover = x;
      this.showValue(plot);
    };
    setProperties(canvas, {
      onwheel: (event) => {
        event.preventDefault();
        axis.zoom(2 ** (-wheelPixels(event) / 200), at(event));
      },
      onpointerdown: (event) => {
        drag = at(event);
        canvas.setPointerCapture(event.pointerId);
      },
      onpointerup: () => (drag = null),
      onpointermove: (event) => {
        if (drag !== null) axis.pan(at(event) - drag);
        if (drag !== null) drag = at(event);
        hover(at(event));
      },
      onpointerleave: () => hover(null),
      ondblclick: (event) => clock.seek(axis.time(at(event)))
    });
  }

  /** The value under the pointer, else that at the cursor. */
  showValue(plot) {
    const time = plot.hover === null ? this.session.time : this.axis.time(plot.hover),
      value = plot.series.at(time);
    setText(
      plot.value,
      plot.series.note ||
        (value === null
          ? "–"
          : `${typeof value === "number" ? Number(value.toPrecision(7)) : value}${plot.hover === null ? "" : ` at ${(time / SECOND).toFixed(3)} s`}`)
    );
  }

  moveCursors() {
    for (const plot of this.plots) {
      placeCursor(plot.cursor, this.axis, this.axis.x(this.session.time));
      if (plot.hover === null) this.showValue(plot);
    }
  }

  repaint() {
    for (const plot of this.plots) plot.surface.invalidate();
    this.moveCursors();
  }
}
