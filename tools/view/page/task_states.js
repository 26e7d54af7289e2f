// SPDX-License-Identifier: BSD-3-Clause
// The state of a task between two successive events of its own: events are the ends of its waits and the uses of
// primitives, and the time between them is spent computing, waiting for an object, or asleep.

const STATES = {
  running: {name: "running", pattern: null},
  ready: {name: "ready", pattern: "dotted"},
  blocked: {name: "blocked", pattern: "rising"},
  idle: {name: "idle", pattern: null},
  late: {name: "late", pattern: "upright"}
};

/** Operations after which a task waits, if the following event is unknown. */
const WAITS = new Set([
  "wait",
  "acquire",
  "join",
  "receive",
  "accept",
  "connect",
  "poll",
  "arrive",
  "lock",
  "lock_shared"
]);

/**
 * The state between the events `before` and `after` (indices, or -1: not known) of a task, and the object it waits for
 * (-1: none). At one instant a task is at most "ready": its event is in the event list.
 */
function stateBetween(store, before, after) {
  const was = before >= 0 ? store.operationName(before) : "",
    is = after >= 0 ? store.operationName(after) : "";
  if (was === "end" || is === "start") return {state: null, object: -1};
  // A process that was forked begins in the middle of its parent's task.
  if (store.shift && before < 0 && store.first === 1) return {state: null, object: -1};
  if (is === "resume" || is === "timeout") {
    const object = store.object[after] >= 0 ? store.object[after] : before >= 0 ? store.object[before] : -1;
    const timer = was === "timer_wait" || (object >= 0 && store.objects[object].kind === "timer");
    return {state: timer ? "idle" : "blocked", object};
  }
  if (is === "sleep" || (after < 0 && was === "timer_wait")) return {state: "idle", object: -1};
  if (after < 0 && store.waits) {
    // No later event shows the wait of the very last event's task.
    const last = before === store.count - 1 && WAITS.has(was) ? store.object[before] : -1,
      awaited = store.waits.get(store.task[before]) ?? last;
    return {state: awaited >= 0 ? "blocked" : null, object: awaited};
  }
  if (after < 0) return WAITS.has(was) ? {state: "blocked", object: store.object[before]} : {state: null, object: -1};
  const still = store.shift && before >= 0 && store.instant(before) === store.instant(after);
  return {state: is === "yield" || still ? "ready" : "running", object: -1};
}

/**
 * The instant at which the activation of a periodic task begins with the event at a lane's place: a tick resumes it, or has come
 * before it was waited for. null if the activation ends there, undefined if the event changes nothing.
 */
function activationFrom(store, lane, place) {
  const event = lane[place],
    object = store.object[event];
  if (store.operationName(event) === "timer_wait") {
    return place + 1 < lane.length && store.operationName(lane[place + 1]) !== "resume" ? store.time[event] : null;
  }
  if (store.operationName(event) !== "resume" || object < 0 || store.objects[object].kind !== "timer") return undefined;
  return store.time[event];
}

/** The begin of the activation under way just before a lane's place; null if none is. */
function activationBefore(store, lane, place) {
  // An activation has tens of events; a task that does not wait for its timer for thousands has no period in this
  // sense.
  for (let i = place - 1, end = Math.max(0, place - 2000); i >= end; --i) {
    const activation = activationFrom(store, lane, i);
    if (activation !== undefined) return activation;
  }
  return null;
}

/** The state at `time` of a task of the protocol's "tasks", until its next event: null if none, or unknown. */
function quietState({state, operation, local}, time) {
  if (/^(sleep|timer_wait)$/.test(operation)) return "idle";
  if (state === "blocked") return "blocked";
  return state !== "ended" && local > time ? "running" : null;
}

/**
 * Where a task waits at the cursor: after `executed` events of the store, at `time`. The fields of the protocol's
 * "tasks".
 */
function taskAt(store, task, executed, time) {
  const lane = store.lanes[task];
  const next = firstWhere(lane.length, (i) => lane[i] >= executed);
  const before = next > 0 ? lane[next - 1] : -1,
    after = next < lane.length ? lane[next] : -1;
  const {state, object} = stateBetween(store, before, after);
  const {number, name, robot} = store.tasks[task];
  const until = after >= 0 && store.operationName(after) === "timeout" ? store.time[after] : null;
  return {
    number,
    name,
    robot,
    events: next,
    local: before >= 0 ? Math.max(store.time[before], Math.min(time, after >= 0 ? store.time[after] : time)) : time,
    state: state ?? (before < 0 ? "not started" : "ended"),
    operation: before >= 0 ? store.operationName(before) : "",
    deadline: until,
    work: "",
    object: object >= 0 ? {...store.objects[object], owner: null} : null
  };
}
