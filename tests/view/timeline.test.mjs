// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, seek, settle, shareOf} from './browser.mjs';
import {SECOND, sampleRun} from './sample_run.mjs';

const CANVAS = '.lane-window canvas',
  MS = 1e6;
let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(sampleRun()), {height: 1100});
  await page.evaluate(() => (document.getElementById('timeline').style.height = '480px'));
  await settle(page);
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

const show = async (from, to) => {
  await page.evaluate((a, b) => window.waitpoint.parts.axis.set(a, b), from, to);
  await settle(page);
};
const x = (time) => page.evaluate((at) => window.waitpoint.timePixels(at), time);
const lane = (name) =>
  page.evaluate((wanted) => {
    const {timeline} = window.waitpoint.parts,
      row = timeline.rows.rows.find((one) => one.kind === 'task' && one.tasks[0].name === wanted);
    return {top: 20 + row.y - timeline.top, height: row.height};
  }, name);

/** The part of a lane between two instants that has the colour of a state. */
async function share(task, state, from, to) {
  const colours = await page.evaluate(() => window.waitpoint.theme.colours),
    {top, height} = await lane(task),
    left = (await x(from)) + 2,
    right = (await x(to)) - 2;
  return shareOf(page, CANVAS, colours[state], left, top + height * 0.3, right - left, height * 0.4);
}

test('states of tasks have their colours at their times', async () => {
  await show(1999 * MS, 2004 * MS);
  assert.ok((await share('ndd.motion', 'running', 2000.3 * MS, 2002 * MS)) > 0.9);
  assert.equal(await share('ndd.motion', 'running', 2002.4 * MS, 2003.5 * MS), 0);
  assert.ok((await share('pom.fusing', 'blocked', 2000.3 * MS, 2002 * MS)) > 0.05);
  assert.equal(await share('pom.fusing', 'running', 2000.3 * MS, 2002 * MS), 0);
  assert.ok((await share('rflex.motion', 'idle', 2000.4 * MS, 2003 * MS)) > 0.05);
});

test('what goes on after the period is late', async () => {
  await show(2990 * MS, 3040 * MS);
  assert.ok((await share('segloc.slam', 'running', 3002 * MS, 3018 * MS)) > 0.9);
  assert.ok((await share('segloc.slam', 'late', 3021 * MS, 3027 * MS)) > 0.2);
  assert.equal(await share('segloc.slam', 'late', 3002 * MS, 3018 * MS), 0);
});

test('a click selects an event, with what woke its task', async () => {
  await show(1999 * MS, 2004 * MS);
  const {top, height} = await lane('pom.fusing');
  const at = await page.evaluate(() => {
    const {timeline} = window.waitpoint.parts,
      {store} = timeline.data,
      task = store.tasks.findIndex((one) => one.name === 'pom.fusing');
    const event = [...store.lanes[task]].find((index) => store.time[index] === 2002.2e6),
      box = timeline.canvas.getBoundingClientRect();
    return {x: box.x + timeline.places.of(event), y: box.y};
  });
  await page.mouse.click(at.x, at.y + top + height / 2);
  await settle(page);
  const event = await page.evaluate(() => window.waitpoint.session.event);
  assert.equal(event.task, 'pom.fusing');
  assert.equal(event.operation, 'resume');
  assert.equal(event.waker.task, 'ndd.motion');
  assert.equal(event.waker.operation, 'unlock');
  const text = await page.$eval('#panel-event', (panel) => panel.textContent);
  assert.ok(text.includes('mutex#3 "poster"') && text.includes('ndd.motion: unlock'));
});

test('an arrow leads from the task that wakes to the one that resumes', async () => {
  const places = await page.evaluate(() => {
    const {timeline} = window.waitpoint.parts,
      {session} = window.waitpoint,
      {store} = timeline.data;
    return [session.event.waker.number, session.event.number].map((number) => timeline.places.of(number - store.first));
  });
  const from = await lane('ndd.motion'),
    to = await lane('pom.fusing'),
    select = await page.evaluate(() => window.waitpoint.theme.colours.select);
  const top = Math.min(from.top, to.top) + 20,
    height = Math.abs(from.top - to.top) - 20;
  assert.ok(
    (await shareOf(page, CANVAS, select, Math.min(...places) - 12, top, Math.abs(places[1] - places[0]) + 24, height)) >
      0.01
  );
});

test('with the keyboard: events of the task, other tasks, and to the event', async () => {
  await page.focus(CANVAS);
  const selected = () => page.evaluate(() => window.waitpoint.session.event);
  const first = await selected();
  await page.keyboard.press('ArrowRight');
  assert.deepEqual([(await selected()).task, (await selected()).operation], [first.task, 'unlock']);
  await page.keyboard.press('ArrowDown');
  assert.equal((await selected()).task, 'ndd.control');
  await page.keyboard.press('ArrowUp');
  assert.equal((await selected()).task, 'pom.fusing');
  await page.keyboard.press('Enter');
  await settle(page);
  assert.equal(await page.evaluate(() => window.waitpoint.session.frame.events), (await selected()).number);
});

test('the wheel zooms about the pointer, down to nanoseconds', async () => {
  await show(0, 20 * SECOND);
  const box = await page.$eval(CANVAS, (canvas) => ({...canvas.getBoundingClientRect().toJSON()})),
    at = await x(8 * SECOND);
  await page.mouse.move(box.x + at, box.y + 60);
  for (let i = 0; i < 60; ++i) await page.mouse.wheel({deltaY: -200});
  await settle(page);
  const {from, to} = await page.evaluate(() => ({
    from: window.waitpoint.parts.axis.from,
    to: window.waitpoint.parts.axis.to
  }));
  assert.ok(to - from <= 100 && from < 8.05 * SECOND && to > 7.95 * SECOND);
  for (let i = 0; i < 60; ++i) await page.mouse.wheel({deltaY: 200});
  assert.ok(await page.evaluate(() => window.waitpoint.parts.axis.whole));
});

test('a wide view shows densities, and deadlines that were missed', async () => {
  const long = await openPage(browser, recordedPage(sampleRun({seconds: 60}), 'long.html'));
  const colours = await long.evaluate(() => window.waitpoint.theme.colours);
  assert.equal(await long.evaluate(() => window.waitpoint.parts.timeline.places === null), true);
  assert.ok((await shareOf(long, CANVAS, '#4095c6', 165, 20, 800, 200)) > 0.02);
  await long.evaluate(() => window.waitpoint.parts.timeline.reveal('ada/segloc.slam/9'));
  await settle(long);
  assert.ok((await shareOf(long, CANVAS, colours.late, 165, 20, 800, 200)) > 0);
  assert.deepEqual(long.problems, []);
  await long.close();
});

test('groups close and open', async () => {
  await show(1999 * MS, 2004 * MS);
  const rows = () => page.$$eval('.lane-label', (labels) => labels.length),
    before = await rows();
  await page.click('[data-group="module ada rflex"]');
  await settle(page);
  assert.equal(await rows(), before - 1);
  assert.equal(
    await page.$eval('[data-group="module ada rflex"]', (button) => button.getAttribute('aria-expanded')),
    'false'
  );
  await page.click('[data-group="robot ada"]');
  await settle(page);
  assert.equal(await rows(), 3);
  await page.click('[data-group="robot ada"]');
  await page.click('[data-group="module ada rflex"]');
  await settle(page);
  assert.equal(await rows(), before);
});

test('the filter leaves tasks with a word', async () => {
  await page.type('#lane-filter', 'motion');
  await settle(page);
  assert.deepEqual(await page.$$eval('.lane-name', (names) => names.map((name) => name.textContent)), [
    'motion',
    'motion'
  ]);
  await page.$eval('#lane-filter', (field) => {
    field.value = '';
    field.dispatchEvent(new Event('input'));
  });
});

test('the ruler moves the cursor that plan and slider share', async () => {
  await show(0, 20 * SECOND);
  const box = await page.$eval(CANVAS, (canvas) => ({...canvas.getBoundingClientRect().toJSON()}));
  await page.mouse.click(box.x + (await x(15 * SECOND)), box.y + 8);
  await settle(page);
  const time = await page.evaluate(() => window.waitpoint.session.time);
  assert.ok(Math.abs(time - 15 * SECOND) < 0.03 * SECOND);
  assert.equal(Number(await page.$eval('#slider', (slider) => slider.value)), time);
  const line = await page.$eval('.lane-window .cursor', (cursor) => cursor.getBoundingClientRect().x + 1);
  assert.ok(Math.abs(line - box.x - (await x(time))) < 2);
});

test('the tasks at the cursor: what each waits for', async () => {
  await seek(page, 2001 * MS);
  await page.click('#tab-tasks');
  await settle(page);
  const rows = await page.$$eval('#panel-tasks tbody tr', (all) =>
    all.map((row) => [...row.children].map((cell) => cell.textContent))
  );
  const row = rows.find(([name]) => name === 'pom.fusing');
  assert.equal(row[1], 'blocked');
  assert.match(row[3], /lock mutex#3 "poster"/);
  assert.equal(rows.find(([name]) => name === 'ndd.motion')[1], 'running');
  assert.equal(rows.find(([name]) => name === 'rflex.motion')[1], 'idle');
});
