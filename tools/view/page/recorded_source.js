// SPDX-License-Identifier: BSD-3-Clause
// A finished run that is in the document itself. It has the methods of LiveSource, and answers at once. A finding has
// other lines beside the run: the nearest schedule without the failure.

class RecordedSource {
  /** text: the run as base64 of gzip of JSON. */
  static async open(text) {
    const bytes = Uint8Array.from(atob(text.replace(/\s+/g, "")), (letter) => letter.charCodeAt(0));
    const unpacked = new Response(bytes).body.pipeThrough(new DecompressionStream("gzip"));
    return new RecordedSource(await new Response(unpacked).json());
  }

  constructor(run) {
    this.run = run;
    this.kind = "recorded";
    this.header = run.header;
    this.control = false;
    this.lines = [run, ...(run.others ?? [])].map((one) => new RecordedLine(one, run.header));
    this.log = run.log ?? [];
    const summary = run.summary ?? "",
      found = (expression) => expression.exec(summary)?.[1] ?? "";
    this.status = {
      time: this.lines[0].to,
      events: this.lines[0].frames.at(-1).events,
      over: true,
      outcome: run.outcome ?? found(/: (.+?) after/),
      summary,
      digest: run.digest ?? found(/(wp1:[0-9a-f]+)/),
      lines: this.lines.map(({to, run: {name}}, line) => ({line, from: 0, parent: null, name: name ?? "run", to}))
    };
  }

  on() {}

  async frame(line, time) {
    const shown = this.lines[line];
    return shown.frameAt(Math.max(0, Math.min(time, shown.to)), null);
  }

  async step(line, count, task, from) {
    return this.lines[line].step(count, task, from);
  }

  async events(line) {
    return this.lines[line].store;
  }

  async counts(line) {
    return this.lines[line].run.counts ?? null;
  }

  async tasks(line, frame) {
    return this.lines[line].tasks(frame);
  }

  /** Modules are recorded at the end only; `time` says so. */
  async modules(line, robot) {
    return this.lines[line].run.modules?.find((modules) => modules.robot === robot) ?? null;
  }

  plottable() {
    return (this.run.plots ?? []).map(({robot, poster, field}) => ({robot, poster, field}));
  }

  async plot(line, wanted) {
    const {plots, plot_times: times} = this.lines[line].run;
    const found = (plots ?? []).find((plot) => ["robot", "poster", "field"].every((key) => plot[key] === wanted[key]));
    return found ? {t: found.t ?? times, v: found.v} : {t: [], v: []};
  }

  trail(line, robot, time, span) {
    return this.lines[line].trail(robot, time, span);
  }

  /** Of a finding's marked events only. */
  async stack(line, event) {
    const mark = this.marks(line).find((one) => one.number === event);
    if (mark?.frames) return mark;
    throw new Error("Not recorded: waitpoint run --serve tells it.");
  }

  /** Events of interest, with a text and a call stack. */
  marks(line) {
    const {store} = this.lines[line];
    return (this.run.marks ?? [])
      .filter((mark) => mark.line === line)
      .map((mark) => ({...store.describe(mark.event - store.first), ...mark}));
  }

  async compare() {
    return this.run.difference ?? {event: null};
  }
}
