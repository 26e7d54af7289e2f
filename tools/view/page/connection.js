// SPDX-License-Identifier: BSD-3-Clause
// The WebSocket to the program: questions with answers, messages without, and new attempts when it breaks.

class Connection {
  /** message(data): pushed messages; changed(): state is "open", "lost" or "refused". */
  constructor(url, message, changed) {
    Object.assign(this, {url, message, changed, state: "lost", pause: 500, next: 1, attempts: 0});
    this.pending = new Map(); // answers that are waited for, by number
    this.waiting = []; // called at the next opening
  }

  /** Resolved when the connection is open for the first time. */
  open() {
    return new Promise((resolve) => {
      this.waiting.push(resolve);
      this.connect();
    });
  }

  connect() {
    ++this.attempts;
    const socket = (this.socket = new WebSocket(this.url));
    socket.onopen = () => {
      this.pause = 500;
      this.attempts = 0;
      this.turn("open");
      for (const resolve of this.waiting.splice(0)) resolve();
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => this.lost();
  }

  receive(text) {
    let data;
    try {
      data = JSON.parse(text);
    } catch {
      return; // not of this protocol
    }
    if (data.id === undefined) return this.message(data);
    const answer = this.pending.get(data.id);
    this.pending.delete(data.id);
    if (answer && data.error !== undefined) answer.reject(new Error(data.error));
    else if (answer) answer.resolve(data);
  }

  ask(ask, fields = {}) {
    if (this.state !== "open") return Promise.reject(new Error("not connected"));
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, {resolve, reject});
      this.socket.send(JSON.stringify({id, ask, ...fields}));
    });
  }

  /** Pauses between attempts grow, to five seconds, since the program may be gone for good. */
  lost() {
    for (const answer of this.pending.values()) answer.reject(new Error("the connection broke"));
    this.pending.clear();
    this.turn("lost");
    setTimeout(() => this.connect(), this.pause);
    this.pause = Math.min(5000, this.pause * 1.6);
  }

  turn(state) {
    this.state = state;
    this.changed();
  }
}
