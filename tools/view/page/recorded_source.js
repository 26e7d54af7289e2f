// SPDX-License-Identifier: BSD-3-Clause
// A finished run that is in the document itself. It has the methods of LiveSource, and answers at once. A finding has
// other lines beside the run: the nearest schedule without the failure.

/** text: base64 of gzip of JSON. */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replace(/\s+/g, "")), (letter) => letter.charCodeAt(0));
  const stream = new Response(bytes).body.pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).json();
}

class RecordedSource {
  constructor(run) {
    this.run = run;
    this.kind = "recorded";
    this.header = withTypes(run.header);
    this.control = false;
    this.finding = run.finding ?? null;
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

  /** Events of interest, with a text and a call stack: of a finding the pair whose order matters. */
  marks(line) {
    const {store} = this.lines[line],
      told = (this.run.marks ?? []).filter((mark) => mark.line === line);
    const marks = store.marked?.map((event, pair) => ({...told.find((mark) => mark.pair === pair), event, pair, line}));
    return (marks ?? told)
      .filter(({event}) => event !== null && event >= store.first && event < store.first + store.count)
      .map((mark) => {
        const event = store.describe(mark.event - store.first),
          text = `${PAIR[mark.pair]}: ${event.task} ${event.operation} ${event.object}`;
        return {text, ...event, ...mark};
      });
  }

  async compare(line, other) {
    return this.run.difference ?? firstDifference(this.lines[line].store, this.lines[other].store);
  }
}

/** Where two schedules part: the first event that differs, as the protocol's "compare" tells it. */
function firstDifference(one, other) {
  const text = (store, index) => {
    if (index >= store.count) return "";
    const {task, operation, object} = store.describe(index);
    return `${task} ${operation} ${object}`;
  };
  for (let number = Math.max(one.first, other.first); ; ++number) {
    const i = number - one.first,
      k = number - other.first;
    if (i >= one.count && k >= other.count) return {event: null};
    const [a, b] = [text(one, i), text(other, k)];
    if (a !== b) return {event: number, time: i < one.count ? one.time[i] : other.time[k], a, b};
  }
}
