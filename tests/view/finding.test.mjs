// SPDX-License-Identifier: BSD-3-Clause
// A finding of the explorer, of threads without robots: the failing schedule beside the nearest passing one.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, settle, shareOf} from './browser.mjs';
import {OPERATIONS} from './sample_run.mjs';

const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const operation = (name) => OPERATIONS.indexOf(name);

/** Two tasks and a mutex, all at one instant; who locks it first is in the list. The consumer waits in the end. */
function schedule(name, order) {
  return {
    name,
    events: {
      kind: 'events',
      from: 0,
      to: 7,
      complete: true,
      first: 1,
      tasks: [
        [0, 'producer', 'test'],
        [1, 'consumer', 'test']
      ],
      objects: [['mutex', 1, 'queue', 'test']],
      t: [0, 1, 1, 1, 1, 1],
      s: [0, 1, 2, 3, 4, 5],
      k: [0, 1, order[0], order[0], order[1], order[1]],
      o: [
        operation('start'),
        operation('start'),
        ...Array(2)
          .fill([operation('lock'), operation('unlock')])
          .flat()
      ],
      x: [-1, -1, 0, 0, 0, 0],
      switches: [2],
      waits: order[0] === 1 ? [[1, 0]] : [],
      marked: order[0] === 1 ? [3, 5] : [5, 3]
    },
    frames: []
  };
}

const at = (name, line) => [{function: name, file: 'queue.cpp', line}, {function: 'main', file: 'queue.cpp', line: 80}];
const mark = (line, pair, frames) => ({line, pair, words: '', frames});
const REPLAY = "WAITPOINT_REPLAY='wx1.1.d730f1c7.=0-1' ./queue_test --gtest_filter=Queue.Waits";
const finding = {
  finding: {
    format: 1,
    schedule: 'schedule 3 of strategy portfolio, seed 3',
    failure: 'deadlock at 0.000000000 s\n  consumer waits for mutex #1 "queue", held by <b>producer</b>\n',
    choice: 'number 0, the next task',
    note: '',
    replay: REPLAY,
    debug: `waitpoint gdb -- ${REPLAY}`,
    steps: '  0.000000000 * consumer#1  lock mutex #1 "queue"\n',
    report: 'schedule 3 failed: deadlock\n'
  },
  header: {
    kind: 'header',
    scenario: 'Queue.Waits',
    seed: 3,
    order: 'explored',
    until: 0,
    program: 'waitpoint test',
    bounds: [0, 0, 0, 0],
    operations: OPERATIONS,
    obstacles: [],
    robots: [],
    control: false
  },
  ...schedule('fails', [1, 0]),
  others: [schedule('passes', [0, 1])],
  marks: [
    mark(0, 0, at('Queue::take()', 31)),
    mark(0, 1, at('Queue::put()', 20)),
    mark(1, 0, at('Queue::take()', 31)),
    mark(1, 1, at('Queue::put()', 20))
  ],
  outcome: 'failed',
  summary: 'schedule 3 failed: deadlock\n'
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

const textOf = (selector) => page.$eval(selector, (found) => found.innerText);

test('the failure is told first, and both schedules with their events and calls in the order of each', async () => {
  assert.equal(await page.$eval('#tab-finding', (tab) => tab.ariaSelected), 'true');
  assert.equal(await textOf('.headline'), 'deadlock at 0.000000000 s');
  assert.match(await textOf('#panel-finding'), /held by <b>producer<\/b>/);
  const [fails, passes] = await page.$$eval('.schedules section', (cards) => cards.map((card) => card.innerText));
  const events = ['consumer of test: lock mutex#1 "queue"', 'Queue::take() queue.cpp:31', 'producer of test: lock'];
  assert.match(fails, new RegExp(`^Fails: A before B.*${events.map(RegExp.escape ?? quote).join('.*')}.*Queue::put\\(\\)`, 's'));
  assert.match(passes, /^Passes: B before A.*producer of test: lock.*put\(\) queue\.cpp:20.*consumer of test.*take\(\)/s);
});

const quote = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

test('both schedules are side by side, without a plan', async () => {
  assert.equal(await page.$eval('#plan', (plan) => plan.hidden), true);
  assert.equal((await page.$$('.lanes-of')).length, 2);
  await page.click('#tab-lines');
  await settle(page);
  const text = await page.$eval('#panel-lines', (panel) => panel.textContent);
  assert.match(text, /0: fails.*1: passes/s);
  assert.match(text, /Event 3 at 0\.000000002 s.*line 0consumer lock.*line 1producer lock/s);
  await page.click('#tab-finding');
});

test('the events whose order matters are marked in both timelines, each at its place', async () => {
  await settle(page);
  const marked = await page.evaluate(() => {
    const {parts, theme} = window.waitpoint;
    return [parts.timeline, parts.beside.timeline].map((view, line) =>
      view.marks
        .filter((mark) => mark.pair !== undefined)
        .map(({pair, number}) => ({
          pair,
          x: view.places.of(number - view.data.store.first),
          y: 20 + view.rows.rowOf.get(`test/${pair ? 'producer' : 'consumer'}/${pair ? 0 : 1}`).y,
          colour: pair ? theme.colours.select : theme.colours.late,
          line
        }))
    );
  });
  assert.deepEqual(marked.map((line) => line.length), [2, 2]);
  const [fails, passes] = marked.map((line) => [...line].sort((one, other) => one.x - other.x).map(({pair}) => pair));
  assert.deepEqual([fails, passes], [[0, 1], [1, 0]]);
  for (const {line, x, y, colour} of marked.flat()) {
    const canvas = `.lanes-of:nth-of-type(${line + 1}) .lane-window canvas`;
    assert.ok((await shareOf(page, canvas, colour, x - 7, y + 3, 14, 14)) > 0.4, `line ${line} at ${x}, ${y}`);
  }
});

test('an event has its call stack, and its time in the run', async () => {
  await page.click('.schedules .good button.link');
  await page.click('#tab-event');
  await settle(page);
  assert.equal(await textOf('#panel-event .stack'), 'Queue::put() queue.cpp:20\nmain queue.cpp:80');
  assert.match(await textOf('#panel-event .facts'), /0\.000000000 s\s+Task\s+producer of test\s+Operation\s+lock/);
  await page.click('#tab-finding');
});

test('a task that waits in the end is blocked, and one that waits for its turn is ready', async () => {
  const states = await page.evaluate(() => {
    const [fails] = window.waitpoint.session.source.lines;
    return fails.tasks({time: 6, events: 6}).map(({name, state}) => `${name} ${state}`);
  });
  assert.deepEqual(states, ['producer ended', 'consumer blocked']);
});

test('the command that repeats it is copied by a button', async () => {
  await page.click('button:has(+ .command)');
  assert.equal(await page.evaluate(() => getSelection().toString()), REPLAY);
  assert.match(await textOf('button:has(+ .command)'), /Copied|Selected/);
});

for (const dark of [false, true])
  test(`axe finds nothing, ${dark ? 'dark' : 'light'}`, async () => {
    const shown = await openPage(browser, recordedPage(finding, 'finding.html'), {dark});
    await shown.evaluate(axe);
    await shown.evaluate(() => document.querySelectorAll('details').forEach((box) => (box.open = true)));
    const found = await shown.evaluate(() => window.axe.run(document, {resultTypes: ['violations']}));
    assert.deepEqual(
      found.violations.flatMap(({id, nodes}) => nodes.map((node) => `${id}: ${node.html.slice(0, 120)}`)),
      []
    );
    await shown.close();
  });

test('a failure without a passing schedule beside it has its steps and its command', async () => {
  const {others, marks, ...alone} = finding;
  const events = {...alone.events, marked: []};
  const told = {...finding.finding, note: 'the default order fails'};
  const shown = await openPage(
    browser,
    recordedPage({...alone, finding: told, events, others: [], marks: []}, 'alone.html')
  );
  assert.match(await shown.$eval('#panel-finding', (panel) => panel.innerText), /None: the default order fails\./);
  assert.equal(await shown.$eval('.command', (line) => line.textContent), REPLAY);
  assert.deepEqual(shown.problems, []);
  await shown.close();
});
