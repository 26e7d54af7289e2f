// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, seek, settle} from './browser.mjs';
import {SECOND, sampleRun} from './sample_run.mjs';

const run = sampleRun();
const times = run.events.t.reduce((all, step) => [...all, (all.at(-1) ?? 0) + step], []);
let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(run));
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

const now = () => page.evaluate(() => window.waitpoint.session.time);
const events = () => page.evaluate(() => window.waitpoint.session.frame.events);
const press = async (key, shift = false) => {
  if (shift) await page.keyboard.down('Shift');
  await page.keyboard.press(key);
  if (shift) await page.keyboard.up('Shift');
  await settle(page);
};

test('the slider moves over the whole run', async () => {
  for (const part of [0.25, 0.5, 1]) {
    const box = await page.$eval('#slider', (slider) => ({...slider.getBoundingClientRect().toJSON()}));
    await page.mouse.click(box.x + 8 + (box.width - 16) * part, box.y + box.height / 2);
    await settle(page);
    assert.ok(Math.abs((await now()) - part * 20 * SECOND) < 0.05 * SECOND);
  }
  assert.match(await page.$eval('#slider', (slider) => slider.getAttribute('aria-valuetext')), / s$/);
});

test('Home and End go to the ends', async () => {
  await page.evaluate(() => document.activeElement.blur());
  await press('Home');
  assert.equal(await now(), 0);
  await press('End');
  assert.equal(await now(), 20 * SECOND);
});

test('arrows step by the period, also on the slider', async () => {
  await seek(page, 5.003 * SECOND);
  await press('ArrowRight');
  assert.equal(await now(), 5.01 * SECOND);
  await press('ArrowRight');
  assert.equal(await now(), 5.02 * SECOND);
  await press('ArrowLeft');
  assert.equal(await now(), 5.01 * SECOND);
  await page.focus('#slider');
  await press('ArrowRight');
  assert.equal(await now(), 5.02 * SECOND);
  await page.select('#period', '1000000');
  await page.evaluate(() => document.activeElement.blur());
  await press('ArrowRight');
  assert.equal(await now(), 5.021 * SECOND);
});

test('Shift and arrows step by an event, back and forth', async () => {
  await seek(page, 5 * SECOND);
  const first = await events();
  for (let i = 1; i <= 4; ++i) {
    await press('ArrowRight', true);
    assert.equal(await events(), first + i);
    assert.equal(await now(), times[first + i - 1]);
  }
  await press('ArrowLeft', true);
  assert.equal(await events(), first + 3);
});

test('steps that come faster than they are made add up', async () => {
  await seek(page, 5 * SECOND);
  const first = await events();
  await page.evaluate(async () => {
    for (let i = 0; i < 25; ++i) window.waitpoint.clock.step(1);
    await window.waitpoint.clock.done;
  });
  assert.equal(await events(), first + 25);
});

test('a period and a comma step by events of the selected task', async () => {
  await seek(page, 6 * SECOND);
  await page.evaluate(() => {
    const {store} = window.waitpoint.parts.timeline.data,
      task = store.tasks.findIndex((one) => one.name === 'ndd.motion');
    window.waitpoint.parts.timelineGestures.select(store.lanes[task][store.atInLane(task, 6e9)]);
  });
  const last = () =>
    page.evaluate(() => {
      const {store} = window.waitpoint.parts.timeline.data;
      return store.describe(window.waitpoint.session.frame.events - store.first).task;
    });
  await press('.');
  assert.equal(await last(), 'ndd.motion');
  assert.ok((await now()) > 6 * SECOND);
  await press(',');
  assert.equal(await last(), 'ndd.motion');
  assert.ok((await now()) <= 6.01 * SECOND);
});

test('an instant can be typed', async () => {
  const type = async (text) => {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press('t');
    await page.keyboard.type(text);
    await page.keyboard.press('Enter');
    await settle(page);
  };
  await type('12.5');
  assert.equal(await now(), 12.5 * SECOND);
  await type('+0.25');
  assert.equal(await now(), 12.75 * SECOND);
  await type('1500 ms');
  assert.equal(await now(), 1.5 * SECOND);
  await type('0:11');
  assert.equal(await now(), 11 * SECOND);
  await type('soon');
  assert.equal(await now(), 11 * SECOND);
  assert.equal(await page.$eval('#time', (field) => field.getAttribute('aria-invalid')), 'true');
  await page.keyboard.press('Escape');
});

test('playing passes time at the chosen speed and stops at the end', async () => {
  await seek(page, 19 * SECOND);
  await page.select('#speed', '50');
  await page.evaluate(() => document.activeElement.blur());
  await press(' ');
  await page.waitForFunction(() => !window.waitpoint.clock.playing, {timeout: 10000});
  assert.equal(await now(), 20 * SECOND);
  await page.select('#speed', '1');
});

test('space begins and ends playing', async () => {
  await seek(page, 0);
  await page.evaluate(() => document.activeElement.blur());
  await press(' ');
  assert.equal(await page.$eval('#play', (button) => button.getAttribute('aria-label')), 'Pause');
  await page.waitForFunction(() => window.waitpoint.session.time > 1e8, {timeout: 10000});
  await press(' ');
  const stopped = await now();
  await settle(page);
  assert.equal(await now(), stopped);
});

test('a question mark lists the keys', async () => {
  await press('?', true);
  assert.ok(await page.$eval('#help-dialog', (dialog) => dialog.open && dialog.textContent.includes('play, pause')));
  await press('Escape');
  assert.ok(!(await page.$eval('#help-dialog', (dialog) => dialog.open)));
});

test('dark and light', async () => {
  const light = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await press('d');
  const dark = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.notEqual(dark, light);
  await press('d');
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), light);
  const other = await openPage(browser, recordedPage(run), {dark: true});
  assert.equal(await other.evaluate(() => getComputedStyle(document.body).backgroundColor), dark);
  await other.close();
});
