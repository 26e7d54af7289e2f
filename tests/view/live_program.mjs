// SPDX-License-Identifier: BSD-3-Clause
// A program with a live run, as far as the page can tell: the protocol's answers, from the sample. Tests break its
// connections and let its run go on.

import http from 'node:http';
import {WebSocketServer} from 'ws';
import {assembled} from './browser.mjs';
import {sampleFrame, sampleHeader, sampleModules, sampleRun, SECOND} from './sample_run.mjs';

export class LiveProgram {
  constructor({robots = 1, control = true, over = false} = {}) {
    this.run = sampleRun({seconds: 20, robots});
    this.header = {...sampleHeader(robots, 20), control};
    this.now = 5 * SECOND; // how far the run has come
    this.over = over;
    this.lines = [{line: 0, from: 0, parent: null, name: 'run', to: this.now}];
    this.asked = []; // all questions
    this.slow = {}; // milliseconds that answers take, by question
    this.under = {}; // questions under way
    this.most = {}; // and the most at once
    this.cursor = {time: 0, events: 0};
    this.times = [];
    this.run.events.t.reduce((time, step) => (this.times.push(time + step), time + step), 0);
    this.paused = false;
  }

  async listen() {
    this.server = http.createServer((request, response) => {
      response.writeHead(200, {'Content-Type': 'text/html; charset=utf-8'});
      response.end(assembled());
    });
    this.sockets = new WebSocketServer({
      server: this.server,
      path: '/live',
      verifyClient: ({req}) => new URL(req.url, 'http://x').searchParams.get('token') === 'secret'
    });
    this.sockets.on('connection', (socket) => {
      socket.on('message', (data) => this.answer(socket, JSON.parse(data)));
    });
    await new Promise((resolve) => this.server.listen(this.port ?? 0, '127.0.0.1', resolve));
    this.port = this.server.address().port;
    this.address = `http://127.0.0.1:${this.port}/?token=secret`;
  }

  async close() {
    for (const socket of this.sockets.clients) socket.terminate();
    this.sockets.close();
    this.server.closeAllConnections();
    await new Promise((resolve) => this.server.close(resolve));
  }

  status() {
    return {
      kind: 'status',
      time: this.now,
      events: this.executed(this.now),
      over: this.over,
      outcome: this.over ? 'finished' : '',
      speed: 1,
      paused: this.paused,
      ...(this.over ? {digest: 'wp1:0123456789abcdef', summary: 'two rooms: finished'} : {}),
      lines: this.lines
    };
  }

  send(message) {
    for (const socket of this.sockets.clients) socket.send(JSON.stringify(message));
  }

  /** The run goes on to a time; those who follow get its frame. */
  advance(time) {
    this.now = this.lines[0].to = time;
    this.send(this.status());
    for (const socket of this.sockets.clients)
      if (socket.follows) socket.send(JSON.stringify(this.frame(0, time, false)));
  }

  executed(time) {
    return this.times.filter((one) => one <= time).length;
  }

  /** In branches robots are half a metre further up. */
  frame(line, time, complete = true, events = this.executed(time)) {
    const frame = {...sampleFrame(this.header, time / SECOND, complete), line, time, events};
    if (line > 0) frame.robots.forEach((robot) => (robot.truth[1] += 0.5));
    return frame;
  }

  answer(socket, {id, ask, ...fields}) {
    this.asked.push({ask, ...fields});
    const slow = this.slow[ask] ?? 0;
    this.most[ask] = Math.max(this.most[ask] ?? 0, (this.under[ask] = (this.under[ask] ?? 0) + 1));
    setTimeout(() => this.reply(socket, id, ask, fields), slow);
  }

  reply(socket, id, ask, fields) {
    --this.under[ask];
    const reply = this.replies[ask]?.call(this, fields, socket) ?? {error: `unknown question ${ask}`};
    socket.send(JSON.stringify({...reply, id}));
    if (ask !== 'header') return;
    socket.send(JSON.stringify({kind: 'log', lines: this.run.log.filter(([time]) => time <= this.now)}));
    socket.send(JSON.stringify(this.status()));
  }

  replies = {
    header: () => this.header,
    counts: () => this.run.counts,
    follow: ({on}, socket) => {
      socket.follows = on;
      return {};
    },
    seek: ({line, time}) => {
      if (time > (this.lines[line]?.to ?? -1)) return {error: 'that is beyond the run'};
      this.cursor = {time, events: this.executed(time)};
      return this.frame(line, time);
    },
    step: ({line, count, task}) => {
      const mine = (event) => task === null || this.run.events.tasks[this.run.events.k[event - 1]][0] === task;
      let events = this.cursor.events;
      for (let left = Math.abs(count); left > 0 && events + Math.sign(count) > 0 && events < this.times.length;) {
        events += Math.sign(count);
        if (mine(events)) --left;
      }
      const time = this.times[events - 1],
        {tasks, k, o} = this.run.events,
        [, name, robot] = tasks[k[events - 1]];
      this.cursor = {time, events};
      return {
        ...this.frame(line, time, true, events),
        event: {
          number: events,
          time,
          task: `${name} of ${robot}`,
          operation: this.header.operations[o[events - 1]],
          object: ''
        }
      };
    },
    events: ({from, to, most}) => {
      const {events} = this.run,
        first = this.times.findIndex((time) => time >= from),
        begin = first < 0 ? this.times.length : first;
      let end = begin;
      while (end < this.times.length && this.times[end] <= Math.min(to, this.now) && end - begin < most) ++end;
      const complete = end >= this.times.length || this.times[end] > Math.min(to, this.now),
        part = (column) => column.slice(begin, end);
      return {
        ...events,
        from,
        to: complete ? to : this.times[end] - 1,
        complete,
        first: begin + 1,
        k: part(events.k),
        o: part(events.o),
        x: part(events.x),
        t: part(this.times).map((time, i) => time - (i ? this.times[begin + i - 1] : from))
      };
    },
    tasks: () => ({
      kind: 'tasks',
      line: 0,
      time: this.cursor.time,
      tasks: [
        {
          number: 3,
          name: 'executive',
          robot: 'ada',
          state: 'blocked',
          local: 4.5e9,
          operation: 'acquire',
          object: {kind: 'semaphore', number: 2, label: 'mailbox event', robot: 'ada', owner: null},
          work: '',
          events: 12
        },
        {
          number: this.run.events.tasks.find(([, name]) => name === 'segloc.slam')?.[0],
          name: 'segloc.slam',
          robot: 'ada',
          state: 'ready',
          local: 3028e6,
          operation: 'lock',
          object: null,
          work: '',
          events: 12
        }
      ]
    }),
    modules: () => ({...sampleModules(this.cursor.time / SECOND), time: this.cursor.time}),
    plot: ({field, from, to, points}) => {
      const plot = this.run.plots.find((one) => one.field === field);
      if (!plot) return {error: `no field ${field}`};
      const kept = this.run.plot_times
        .map((time, i) => [time, plot.v[i]])
        .filter(([time]) => time >= from && time <= Math.min(to, this.now))
        .slice(0, points);
      return {t: kept.map(([time]) => time), v: kept.map(([, value]) => value)};
    },
    stack: ({event}) => ({
      task: 'ndd.motion',
      frames: [
        {function: `waitpoint::modules::Ndd::move(int) event ${event}`, file: 'modules/ndd/ndd.cpp', line: 120},
        {function: 'main', file: '', line: 0}
      ]
    }),
    branch: ({line, time, interventions}) => {
      if (!this.header.control) return {error: 'read only'};
      if (interventions.some((text) => text.startsWith('fly'))) return {error: "unknown intervention 'fly'"};
      this.lines.push({
        line: this.lines.length,
        from: time,
        parent: line,
        name: interventions[0] ?? 'branch',
        to: 10 * SECOND
      });
      this.send(this.status());
      return {line: this.lines.length - 1};
    },
    journal: ({line}) => ({
      text: `waitpoint journal ${line}\n`,
      command: 'waitpoint run two-rooms.yaml --replay-journal branch.journal'
    }),
    compare: () => ({
      event: 2313,
      time: 2002200000,
      a: '2.002200000 ada pom.fusing resume',
      b: '2.002200000 ada ndd.motion unlock'
    }),
    pause: ({on}) => {
      this.paused = on;
      this.send(this.status());
      return {};
    },
    speed: () => ({})
  };
}
