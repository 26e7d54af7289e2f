// SPDX-License-Identifier: BSD-3-Clause
// A run for the tests, in the form that `waitpoint run --page` writes: a robot on rounds through two rooms, or many
// robots. All of it is computed from the time, so that a test knows where everything is.

import {sampleEvents} from './sample_events.mjs';

export const SECOND = 1e9;
export const OPERATIONS = [
  'start',
  'end',
  'resume',
  'timeout',
  'yield',
  'sleep',
  'lock',
  'try_lock',
  'unlock',
  'wait',
  'notify_one',
  'notify_all',
  'acquire',
  'try_acquire',
  'release',
  'join',
  'timer_wait',
  'timer_tick',
  'step'
];

const GOALS = [
  {x: 8, y: 2, name: 'east'},
  {x: 8, y: 6, name: 'north'},
  {x: 2, y: 6, name: '<b>west</b>'}
];
const box = (name, x0, y0, x1, y1, high, known = true) => ({
  name,
  outline: [
    [x0, y0],
    [x1, y0],
    [x1, y1],
    [x0, y1]
  ],
  low: 0,
  high,
  known
});
const OBSTACLES = [
  box('south wall', 0, 0, 12, 0.2, 2.6),
  box('north wall', 0, 7.8, 12, 8, 2.6),
  box('west wall', 0, 0, 0.2, 8, 2.6),
  box('east wall', 11.8, 0, 12, 8, 2.6),
  box('desk', 4, 3.4, 6, 4.6, 0.75),
  box('crate', 9.5, 3.5, 10.5, 4.5, 1, false),
  {name: 'pillar', x: 10.5, y: 6.5, radius: 0.3, low: 0, high: 2.6, known: true}
];

/** The pose at a time in seconds: along the sides of a rectangle, a side in five seconds. */
export function poseAt(seconds) {
  const corners = [
    [2, 2],
    [8, 2],
    [8, 6],
    [2, 6]
  ];
  const side = Math.floor(seconds / 5) % 4,
    part = seconds / 5 - Math.floor(seconds / 5);
  const [x0, y0] = corners[side],
    [x1, y1] = corners[(side + 1) % 4];
  return [x0 + (x1 - x0) * part, y0 + (y1 - y0) * part, Math.atan2(y1 - y0, x1 - x0), 0];
}

/** Robots of a crowd stand on a grid and turn. */
export function crowdPose(index, seconds) {
  return [0.5 + (index % 40) * 0.28, 0.5 + Math.floor(index / 40) * 0.28, ((index + seconds) % 6) - 3, 0];
}

const value = (name) => ({name, kind: 'value', parts: []});
const record = (name, ...parts) => ({name, kind: 'record', parts});

const POSTERS = [
  {
    name: 'pom.position',
    writer: 'pom',
    fields: record('position', value('date'), record('pose', value('x'), value('y'), value('heading')))
  },
  {name: 'ndd.reference', writer: 'ndd', fields: record('reference', value('v_m_s'), value('w_rad_s'))},
  {
    name: 'rflex.sonars',
    writer: 'rflex',
    fields: record('sonars', {name: 'echoes', kind: 'list', parts: [record('echo', value('range_m'))]})
  }
];

const MODULES = [
  ['rflex', 'motion', 20],
  ['sick', 'scanning', 20],
  ['segloc', 'slam', 20],
  ['pom', 'fusing', 40],
  ['ndd', 'motion', 100]
].map(([name, task, period]) => ({
  name,
  tasks: [{name: task, period: period * 1e6}],
  requests: [
    {name: 'Stop', kind: 'control', fields: record('Stop')},
    {name: 'GoTo', kind: 'execution', fields: record('GoTo', value('x'), value('y'))}
  ]
}));

export function sampleHeader(robots, seconds) {
  const crowd = robots > 1;
  return {
    kind: 'header',
    scenario: crowd ? 'crowd' : 'two rooms',
    seed: 7,
    order: 'fifo',
    until: seconds * SECOND,
    program: 'waitpoint test',
    bounds: [0, 0, 12, 8],
    operations: OPERATIONS,
    obstacles: OBSTACLES,
    control: false,
    robots: Array.from({length: robots}, (_, i) => ({
      name: crowd ? `r${i}` : 'ada',
      outline: null,
      radius: crowd ? 0.1 : 0.25,
      low: 0,
      high: 1.2,
      lasers: crowd ? [] : [{name: 'laser', x: 0.1, y: 0, heading: 0}],
      sonars: crowd ? [] : [0, 1, 2, 3].map((k) => ({x: 0, y: 0, heading: (k * Math.PI) / 2, width: 0.4, range: 3})),
      goals: crowd ? [] : GOALS,
      modules: i === 0 ? MODULES : [],
      posters: i === 0 ? POSTERS : []
    }))
  };
}

export function sampleFrame(header, seconds, complete) {
  const crowd = header.robots.length > 1,
    tick = Math.round(seconds * 10);
  const robots = header.robots.map((robot, i) => {
    const truth = crowd ? crowdPose(i, seconds) : poseAt(seconds);
    const estimate = [truth[0] + 0.05, truth[1] - 0.03, truth[2] + 0.02],
      reached = Math.min(3, Math.floor(seconds / 5));
    const state = {
      truth,
      estimate,
      covariance: [0.01, 0.002, 0.004],
      odometry: [truth[0] + 0.2, truth[1], truth[2]],
      goal: reached < 3 && !crowd ? reached : -1,
      goals_reached: crowd ? 0 : reached,
      collisions: 0
    };
    if (!crowd && (complete || tick % 2 === 0)) {
      state.scans = [
        {
          laser: 0,
          first: -Math.PI / 2,
          step: Math.PI / 90,
          max: 8,
          ranges: Array.from({length: 91}, (_, k) => 1.5 + Math.sin(k / 9))
        }
      ];
      state.sonars = [1, 2, 3, 3];
    }
    if (!crowd && (complete || tick % 50 === 0)) {
      state.route = [truth.slice(0, 2), [8, 2]];
      state.segments = [[0.2, 0.2, 11.8, 0.2]];
    }
    return state;
  });
  return {kind: 'frame', line: 0, time: Math.round(seconds * SECOND), events: 0, robots};
}

/** The whole run; with `robots` above 1 a crowd, whose events are those of the first robot. */
export function sampleRun({robots = 1, seconds = 20} = {}) {
  const header = sampleHeader(robots, seconds),
    {columns, times} = sampleEvents(header.robots[0].name, seconds, OPERATIONS);
  const frames = Array.from({length: seconds * 10 + 1}, (_, k) => sampleFrame(header, k / 10, false));
  let executed = 0;
  for (const frame of frames) {
    while (executed < times.length && times[executed] <= frame.time) ++executed;
    frame.events = executed;
  }
  const periods = seconds + 1,
    events = columns.tasks.map(() => Array(periods).fill(0)),
    missed = columns.tasks.map(() => Array(periods).fill(0));
  times.forEach((time, i) => ++events[columns.k[i]][Math.floor(time / SECOND)]);
  missed[columns.tasks.findIndex(([, name]) => name === 'segloc.slam')][3] = 1;
  const plotTimes = frames.map((frame) => frame.time);
  const plot = (poster, field, values) => ({robot: 0, poster, field, v: values});
  return {
    header,
    frames,
    events: columns,
    counts: {kind: 'counts', period: SECOND, periods, from: 0, tasks: columns.tasks, events, missed},
    tasks: {kind: 'tasks', line: 0, time: seconds * SECOND, tasks: []},
    modules: [sampleModules(seconds)],
    plot_times: plotTimes,
    plots: [
      plot(
        'pom.position',
        'pose.x',
        plotTimes.map((time) => poseAt(time / SECOND)[0])
      ),
      plot(
        'pom.position',
        'pose.y',
        plotTimes.map((time) => (time < 2 * SECOND ? null : poseAt(time / SECOND)[1]))
      ),
      plot(
        'ndd.reference',
        'v_m_s',
        plotTimes.map((time) => (Math.floor(time / SECOND / 5) % 2 ? 0.8 : 1.2))
      )
    ],
    log: [
      [0, 0, 'executive', 'segloc GoTo: sent', false],
      [3 * SECOND, 0, 'segloc', 'slam: a deadline missed by 8 ms <img src=x onerror=alert(1)>', true],
      [5 * SECOND, 0, 'executive', 'ndd GoTo east: ok', false]
    ],
    summary:
      'two rooms, seed 7: finished after 20.0 s simulated\n\n  goals reached     3 of 3\n\n  digest            wp1:00112233445566aa\n'
  };
}

export function sampleModules(seconds) {
  return {
    kind: 'modules',
    line: 0,
    time: seconds * SECOND,
    robot: 0,
    modules: MODULES.map((module) => ({
      name: module.name,
      activities: module.name === 'ndd' ? [{number: 4, request: 'GoTo', state: 'exec', input: 'x 8 y 2'}] : [],
      tasks: module.tasks.map((task) => ({
        ...task,
        missed_periods: 0,
        missed_deadlines: module.name === 'segloc' ? 1 : 0,
        greatest_lateness: module.name === 'segloc' ? 8e6 : 0,
        suspended: false
      }))
    })),
    posters: [
      {name: 'pom.position', date: seconds * SECOND - 2e7, text: 'date 1.5 pose {x 1 y 2 heading 0.5}'},
      {name: 'ndd.reference', date: null, text: null},
      {name: 'rflex.sonars', date: 0, text: 'echoes {{range_m 1.25} {range_m 3}}'}
    ]
  };
}
