// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {seek, settle, shareOf} from './browser.mjs';
import {open, page, program, text, until} from './live_page.mjs';
import {poseAt, SECOND} from './sample_run.mjs';

const time = () => page.evaluate(() => window.waitpoint.session.time);

test('the run is followed as it goes', async () => {
  await open();
  assert.ok(program.asked.some(({ask, on}) => ask === 'follow' && on));
  program.advance(7.5 * SECOND);
  await until((wanted) => window.waitpoint.session.time === wanted, 7.5 * SECOND);
  await settle(page);
  const [x, y] = poseAt(7.5),
    at = await page.evaluate((u, v) => window.waitpoint.pixels(u, v), x, y),
    [colour] = await page.evaluate(() => window.waitpoint.theme.colours.robots);
  assert.ok((await shareOf(page, '#plan-canvas', colour, at.x - 20, at.y - 20, 40, 40)) > 0.05);
  assert.equal(await page.$eval('#slider', (slider) => Number(slider.max)), 7.5 * SECOND);
  assert.equal(await text('#connection'), 'connected');
  assert.deepEqual(page.problems, []);
});

test('going back leaves the run, and g returns to it', async () => {
  await open();
  await seek(page, 2 * SECOND);
  program.advance(8 * SECOND);
  await settle(page);
  assert.equal(await time(), 2 * SECOND);
  assert.equal(program.asked.filter(({ask}) => ask === 'follow').at(-1).on, false);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('g');
  await settle(page);
  program.advance(9 * SECOND);
  await until((wanted) => window.waitpoint.session.time === wanted, 9 * SECOND);
});

test('a run that is over is shown at its end, and not followed', async () => {
  await open({over: true});
  assert.equal(await time(), 5 * SECOND);
  assert.equal(await page.$eval('#live', (button) => button.getAttribute('aria-pressed')), 'false');
  await seek(page, 2 * SECOND);
  await page.click('#live');
  await settle(page);
  assert.equal(await time(), 5 * SECOND);
  assert.equal(await page.$eval('#live', (button) => button.getAttribute('aria-pressed')), 'false');
});

test('a task that computes in all of the view is drawn as late', async () => {
  await open();
  await seek(page, 3024e6);
  await page.type('#lane-filter', 'slam');
  await page.evaluate(() => window.waitpoint.parts.axis.set(3023e6, 3025e6));
  await until(() => window.waitpoint.parts.timeline.data.store?.from < 3000e6);
  await settle(page);
  const {top, height, colour} = await page.evaluate(() => {
    const {timeline} = window.waitpoint.parts,
      row = timeline.rows.rows.find((one) => one.kind === 'task');
    return {top: 20 + row.y - timeline.top, height: row.height, colour: window.waitpoint.theme.colours.late};
  });
  assert.ok((await shareOf(page, '.lane-window canvas', colour, 200, top + height * 0.3, 400, height * 0.4)) > 0.2);
});

test('steps, tasks, modules, plots and stacks are asked for', async () => {
  await open();
  await seek(page, 2 * SECOND);
  const before = await page.evaluate(() => window.waitpoint.session.frame.events);
  await page.keyboard.down('Shift');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.up('Shift');
  await settle(page);
  assert.equal(await page.evaluate(() => window.waitpoint.session.frame.events), before + 1);
  await page.click('#tab-tasks');
  await settle(page);
  assert.match(await text('#panel-tasks tbody'), /executive.*blocked.*acquire semaphore#2 "mailbox event"/);
  await page.click('#tab-modules');
  await settle(page);
  assert.match(await text('#panel-modules'), /ndd GoTo/);
  await page.evaluate(() => window.waitpoint.parts.axis.set(1999e6, 2004e6));
  await settle(page);
  await page.evaluate(() => window.waitpoint.parts.timelineGestures.select(3));
  await until(() => document.querySelector('#panel-event .stack').textContent.includes('modules/ndd/ndd.cpp:120'));
  const fields = await page.$$eval('#plot-field option', (options) => options.map((option) => option.textContent));
  assert.ok(fields.includes('pom.position pose.heading') && fields.includes('ndd.reference w_rad_s'));
});

test('the events of a live run are asked for by the view', async () => {
  await open();
  await page.evaluate(() => window.waitpoint.parts.axis.set(1999e6, 2004e6));
  await until(() => window.waitpoint.parts.timeline.places !== null);
  assert.equal(
    await page.evaluate(() => {
      const {store} = window.waitpoint.parts.timeline.data;
      return store.describe(store.at(1999.9e6)).task;
    }),
    'world'
  );
});

test('a connection that breaks is told and tried again', async () => {
  await open();
  await seek(page, 3 * SECOND);
  await program.close();
  await until(() => document.getElementById('connection').textContent.includes('connection lost'));
  await page.keyboard.press('Home');
  await until(() => document.getElementById('message').textContent === 'not connected');
  await program.listen();
  await until(() => document.getElementById('connection').textContent === 'connected');
  await seek(page, 4 * SECOND);
  assert.equal(await time(), 4 * SECOND);
  const lines = await page.evaluate(() => window.waitpoint.session.source.log.length);
  assert.equal(lines, program.run.log.filter(([at]) => at <= program.now).length);
});

test('errors are told in a line', async () => {
  await open();
  program.lines[0].to = 20 * SECOND;
  program.send(program.status());
  await settle(page);
  program.lines[0].to = 5 * SECOND;
  await seek(page, 19 * SECOND);
  assert.equal(await text('#message'), 'that is beyond the run');
  assert.equal(await page.$eval('#message', (line) => line.getAttribute('role')), 'alert');
});

test('the run is held and let go', async () => {
  await open();
  await page.click('#tab-run');
  await settle(page);
  await page.evaluate(() =>
    [...document.querySelectorAll('#panel-run button')].find((button) => button.textContent === 'Hold the run').click()
  );
  await until(() => document.querySelector('#panel-run button').getAttribute('aria-pressed') === 'true');
  assert.ok(program.paused);
});

test('at the end of the run its summary is there', async () => {
  await open();
  program.over = true;
  program.advance(20 * SECOND);
  await page.click('#tab-run');
  await until(() => document.getElementById('panel-run').textContent.includes('two rooms: finished'));
  assert.match(await text('#facts'), /finished · wp1:0123456789abcdef/);
  assert.equal(await time(), 20 * SECOND);
});

test('of many robots only those in view are asked for, in detail the one that is selected', async () => {
  await open({robots: 100});
  await page.evaluate(() => window.waitpoint.clock.setLive(true));
  await page.evaluate(() => {
    const {camera, repaintPlans} = window.waitpoint.parts;
    camera.zoom(8, 100, 100);
    camera.fitted = false;
    repaintPlans();
    window.waitpoint.session.changed('time');
  });
  await new Promise((resolve) => setTimeout(resolve, 600));
  const {view, robot} = program.asked.filter(({ask}) => ask === 'follow').at(-1),
    area = (view[2] - view[0]) * (view[3] - view[1]);
  assert.equal(robot, 0);
  assert.ok(area < 40, `${view}`);
});

test('a slow program is not asked again before it has answered', async () => {
  await open();
  program.most = {};
  program.slow = {plot: 900, events: 600, counts: 600, tasks: 500, modules: 500, stack: 700};
  await page.evaluate(() => window.waitpoint.parts.plots.add({robot: 0, poster: 'pom.position', field: 'pose.x'}));
  await page.click('#tab-tasks');
  for (let i = 0; i < 20; ++i) {
    program.advance((5 + i / 10) * SECOND);
    await page.evaluate((at) => window.waitpoint.parts.axis.set(at, at + 5e6), (1 + i / 100) * SECOND);
    await new Promise((resolve) => setTimeout(resolve, 80));
  }
  await page.evaluate(() => window.waitpoint.clock.seek(2e9));
  await new Promise((resolve) => setTimeout(resolve, 1500));
  for (const ask of ['plot', 'events', 'counts', 'tasks'])
    assert.ok((program.most[ask] ?? 0) <= 1, `${ask}: ${program.most[ask]} at once`);
  assert.ok(program.asked.filter(({ask}) => ask === 'plot').length <= 5);
});
