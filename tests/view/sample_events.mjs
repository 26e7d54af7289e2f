// SPDX-License-Identifier: BSD-3-Clause
// Events of thirteen tasks: the world's, the bridge's, the executive's, and the control and execution tasks of five
// modules. At 2 s pom.fusing waits for a mutex that ndd.motion holds; at 3 s segloc.slam is late by 8 ms.

const MS = 1e6;

export function sampleEvents(robot, seconds, operations) {
  const tasks = [],
    objects = [],
    events = [];
  const task = (name, owner = robot) => tasks.push([tasks.length + 1, name, owner]) - 1;
  const object = (kind, label, owner = robot) => objects.push([kind, objects.length + 1, label, owner]) - 1;
  // Events of one instant are in the order of their ranks, then of their making: who wakes comes before who resumes.
  const at = (time, of, operation, on = -1, rank = 0) => {
    if (time <= seconds * 1000 * MS)
      events.push({
        time: Math.round(time),
        of,
        operation: operations.indexOf(operation),
        on,
        rank,
        order: events.length
      });
  };

  const world = task('world', 'environment'),
    bridge = task('bridge'),
    executive = task('executive');
  const step = object('semaphore', 'world step'),
    mailbox = object('semaphore', 'mailbox event'),
    shared = object('mutex', 'poster');
  for (const one of [world, bridge, executive]) at(0, one, 'start');
  at(0, bridge, 'acquire', step);
  at(0, executive, 'acquire', mailbox);
  for (let time = 10 * MS; time <= seconds * 1000 * MS; time += 10 * MS) {
    at(time, world, 'sleep');
    at(time, world, 'release', step);
    at(time, bridge, 'resume', step);
    at(time, bridge, 'acquire', step);
  }
  for (let time = 500 * MS; time <= seconds * 1000 * MS; time += 500 * MS) {
    at(time, executive, 'timeout', mailbox);
    at(time, executive, 'acquire', mailbox);
  }
  for (const [module, name, period, cost] of [
    ['rflex', 'motion', 20, 0.1],
    ['sick', 'scanning', 20, 0.5],
    ['segloc', 'slam', 20, 1],
    ['pom', 'fusing', 40, 0.2],
    ['ndd', 'motion', 100, 2.2]
  ]) {
    const control = task(`${module}.control`),
      execution = task(`${module}.${name}`),
      timer = object('timer', 'task period'),
      data = object('mutex', 'functional data');
    at(0, control, 'start');
    at(0, control, 'acquire', object('semaphore', 'mailbox event'));
    at(0, execution, 'start');
    at(0, execution, 'timer_wait', timer);
    for (let time = period * MS; time <= seconds * 1000 * MS; time += period * MS) {
      const late = module === 'segloc' && time === 3000 * MS,
        waits = module === 'pom' && time === 2000 * MS,
        holds = module === 'ndd' && time === 2000 * MS;
      if (module === 'segloc' && time === 3020 * MS) continue; // still at the activation before
      const end = time + (late ? 28 : cost) * MS + (waits ? 2.2 * MS : 0);
      at(time, execution, 'resume', timer);
      at(time, execution, 'lock', data);
      if (holds) at(time, execution, 'lock', shared);
      if (waits) {
        at(time + 0.1 * MS, execution, 'lock', shared);
        at(time + 2.2 * MS, execution, 'resume', shared);
        at(time + 2.2 * MS, execution, 'unlock', shared);
      }
      if (holds) at(time + 2.2 * MS, execution, 'unlock', shared, -1);
      at(end, execution, 'unlock', data);
      at(end, execution, 'timer_wait', timer);
    }
  }
  events.sort((one, other) => one.time - other.time || one.rank - other.rank || one.order - other.order);
  const columns = {
    kind: 'events',
    from: 0,
    to: seconds * 1000 * MS,
    complete: true,
    tasks,
    objects,
    first: 1,
    t: events.map((event, i) => event.time - (i ? events[i - 1].time : 0)),
    k: events.map((event) => event.of),
    o: events.map((event) => event.operation),
    x: events.map((event) => event.on)
  };
  return {columns, times: events.map((event) => event.time)};
}
