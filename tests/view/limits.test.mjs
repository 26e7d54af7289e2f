// SPDX-License-Identifier: BSD-3-Clause
// Recorded pages that do not have all: events of the beginning only, and goals that may have been missed.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, seek, settle} from './browser.mjs';
import {SECOND, sampleRun} from './sample_run.mjs';

let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(limitedRun(), 'limits.html'));
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

/** Its first goal was missed, and its events are kept up to about two seconds. */
function limitedRun() {
  const run = sampleRun(),
    {events} = run;
  for (const robot of run.frames.flatMap(({robots}) => robots))
    robot.goals_reached = Math.max(0, robot.goals_reached - 1);
  let end = 0,
    to = 0;
  while (to + events.t[end] <= 2 * SECOND) to += events.t[end++];
  for (const name of ['t', 'k', 'o', 'x']) events[name] = events[name].slice(0, end);
  return {...run, events: {...events, to, complete: false}};
}

const text = (selector) => page.$eval(selector, (element) => element.textContent);
const time = () => page.evaluate(() => window.waitpoint.session.time);
const goals = () =>
  page.$$eval('#panel-robots table:last-of-type tbody tr', (rows) => rows.map((row) => row.lastChild.textContent));

test('a step where no events are kept says so and stays there', async () => {
  for (const count of [1, -1]) {
    await seek(page, 6 * SECOND);
    await page.evaluate((by) => window.waitpoint.clock.step(by), count);
    await settle(page);
    assert.equal(await time(), 6 * SECOND);
    assert.match(await text('#message'), /^Events are kept up to 2(\.0+)? s\.$/);
  }
});

test('the number of events and the tasks are not those of the last event kept', async () => {
  await seek(page, 6 * SECOND);
  const [events, kept] = await page.evaluate(() => [
    window.waitpoint.session.frame.events,
    window.waitpoint.parts.timeline.data.store.count
  ]);
  assert.ok(events > kept);
  await page.click('#tab-tasks');
  await settle(page);
  assert.match(await text('#panel-tasks .note'), /^Events are kept up to 2/);
  assert.equal((await page.$$('#panel-tasks tbody tr')).length, 0);
  await seek(page, 1 * SECOND);
  assert.equal(await text('#panel-tasks .note'), '');
  assert.ok((await page.$$('#panel-tasks tbody tr')).length > 0);
});

test('goals before the next one are reached only if all of them were', async () => {
  await page.click('#tab-robots');
  await seek(page, 6 * SECOND);
  assert.deepEqual(await goals(), ['passed', 'next', '']);
  await seek(page, 20 * SECOND);
  assert.deepEqual(await goals(), ['', '', '']);
});

test('a recorded page has no form for branches', async () => {
  await page.click('#tab-lines');
  await settle(page);
  assert.equal(await page.$('#panel-lines textarea:not([hidden] *)'), null);
});

test('all tabs are in view, also with that of a finding', async () => {
  const finding = {failure: 'a collision', schedule: 'schedule 3', note: 'no schedule passed', replay: 'replay it'},
    opened = await openPage(browser, recordedPage({...sampleRun(), finding}, 'finding-tabs.html'));
  assert.ok(await opened.$('#tab-finding'));
  assert.ok(await opened.$eval('#tabs', (tabs) => tabs.scrollWidth <= tabs.clientWidth));
  await opened.close();
});
