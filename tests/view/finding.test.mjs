// SPDX-License-Identifier: BSD-3-Clause
// A finding of the explorer, of threads without robots: the failing schedule beside the nearest passing one.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, settle, shareOf} from './browser.mjs';
import {OPERATIONS} from './sample_run.mjs';

const operation = (name) => OPERATIONS.indexOf(name);
/** Two tasks and a mutex; who locks it first is in the list. */
function schedule(name, order) {
  return {
    name,
    events: {
      kind: 'events',
      from: 0,
      to: 1000,
      complete: true,
      first: 1,
      tasks: [
        [0, 'producer', 'test'],
        [1, 'consumer', 'test']
      ],
      objects: [['mutex', 1, 'queue', 'test']],
      t: [0, 0, 100, 100, 100, 100],
      k: [0, 1, order[0], order[0], order[1], order[1]],
      o: [
        operation('start'),
        operation('start'),
        ...Array(2)
          .fill([operation('lock'), operation('unlock')])
          .flat()
      ],
      x: [-1, -1, 0, 0, 0, 0]
    }
  };
}

const frames = [
  {function: 'Queue::take()', file: 'queue.cpp', line: 31},
  {function: 'main', file: 'queue.cpp', line: 80}
];
const finding = {
  header: {
    kind: 'header',
    scenario: 'queue_test',
    seed: 3,
    order: 'explored',
    until: 1000,
    program: 'waitpoint test',
    bounds: [0, 0, 0, 0],
    operations: OPERATIONS,
    obstacles: [],
    robots: [],
    control: false
  },
  frames: [],
  ...schedule('fails', [1, 0]),
  others: [{frames: [], ...schedule('passes', [0, 1])}],
  difference: {event: 3, time: 100, a: 'consumer lock mutex#1', b: 'producer lock mutex#1'},
  marks: [
    {line: 0, event: 3, time: 100, text: 'takes from the empty queue', frames},
    {line: 0, event: 5, time: 300, text: 'puts too late', frames: frames.slice(1)}
  ],
  log: [],
  summary: 'queue_test: assertion failed after 0.0 s simulated'
};

let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(finding, 'finding.html'));
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

test('both schedules are side by side, without a plan', async () => {
  assert.equal(await page.$eval('#plan', (plan) => plan.hidden), true);
  assert.equal((await page.$$('.lanes-of')).length, 2);
  const text = await page.$eval('#panel-lines', (panel) => panel.textContent);
  assert.match(text, /0: fails.*1: passes/s);
  assert.match(text, /Event 3 at 0\.000000100 s.*line 0consumer lock.*line 1producer lock/s);
});

test('the events whose order matters are marked in the timeline', async () => {
  const late = await page.evaluate(() => window.waitpoint.theme.colours.late);
  for (const time of [100, 300]) {
    const x = await page.evaluate((at) => window.waitpoint.timePixels(at), time);
    assert.ok((await shareOf(page, '.lane-window canvas', late, x - 3, 22, 6, 60)) > 0.05, `${time} ns`);
  }
});

test('each has its call stack', async () => {
  await page.evaluate(() => [...document.querySelectorAll('.difference button.link')][0].click());
  await settle(page);
  assert.equal(
    await page.$eval('#panel-event .stack', (list) => list.textContent),
    'Queue::take() queue.cpp:31main queue.cpp:80'
  );
  assert.match(
    await page.$eval('#panel-event .facts', (list) => list.textContent),
    /consumer of test.*lock.*mutex#1 "queue"/
  );
});
