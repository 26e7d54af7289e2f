// SPDX-License-Identifier: BSD-3-Clause
// Plots, modules, log and the run's summary.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, seek, settle, shareOf} from './browser.mjs';
import {poseAt, SECOND, sampleRun} from './sample_run.mjs';

let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(sampleRun()));
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

const plots = () =>
  page.$$eval('.plot', (all) =>
    all.map((plot) => [plot.querySelector('.field').textContent, plot.querySelector('output').textContent])
  );

test('a field is plotted, and its value at the cursor told', async () => {
  assert.deepEqual(
    (await plots()).map(([field]) => field),
    ['v_m_s']
  );
  await page.select(
    '#plot-field',
    await page.$$eval(
      '#plot-field option',
      (options) => options.find((option) => option.textContent.endsWith('pose.x')).value
    )
  );
  await page.click('#plot-add');
  await seek(page, 2 * SECOND);
  assert.deepEqual(await plots(), [
    ['v_m_s', '1.2'],
    ['pose.x', String(Number(poseAt(2)[0].toPrecision(7)))]
  ]);
  const colour = await page.evaluate(() => window.waitpoint.theme.colours.robots[1]);
  assert.ok((await shareOf(page, '.plot:nth-child(2) canvas', colour, 165, 0, 800, 60)) > 0.01);
});

test('the curve is where the values are', async () => {
  const colour = await page.evaluate(() => window.waitpoint.theme.colours.robots[0]);
  // 1.2 m/s in the first five seconds, 0.8 m/s in the next: in the upper half, then in the lower.
  const x = (time) => page.evaluate((at) => window.waitpoint.timePixels(at), time);
  const canvas = '.plot:nth-child(1) canvas',
    at = async (from, to, top) =>
      shareOf(page, canvas, colour, await x(from * SECOND), top, (await x(to * SECOND)) - (await x(from * SECOND)), 32);
  assert.ok((await at(1, 4, 0)) > 0.01, 'above');
  assert.equal(await at(1, 4, 32), 0);
  assert.ok((await at(6, 9, 32)) > 0.01, 'below');
  assert.equal(await at(6, 9, 0), 0);
});

test('the value under the pointer is told', async () => {
  const box = await page.$eval('.plot:nth-child(2) canvas', (canvas) => ({...canvas.getBoundingClientRect().toJSON()}));
  await page.mouse.move(box.x + (await page.evaluate(() => window.waitpoint.timePixels(7.55e9))), box.y + 20);
  await settle(page);
  assert.match((await plots())[1][1], /^8 at 7\.\d+ s$/);
});

test('values that are not there make a gap', async () => {
  await page.evaluate(() => window.waitpoint.parts.plots.add({robot: 0, poster: 'pom.position', field: 'pose.y'}));
  await seek(page, SECOND);
  assert.equal((await plots())[2][1], '–');
  await seek(page, 7 * SECOND);
  assert.equal((await plots())[2][1], String(Number(poseAt(7)[1].toPrecision(7))));
});

test("the time axis is the timeline's", async () => {
  await page.evaluate(() => window.waitpoint.parts.axis.set(4e9, 6e9));
  await settle(page);
  const box = await page.$eval('.plot:nth-child(1) canvas', (canvas) => ({...canvas.getBoundingClientRect().toJSON()}));
  await page.mouse.move(box.x + 500, box.y + 20);
  await page.mouse.wheel({deltaY: 2000});
  await settle(page);
  assert.ok(await page.evaluate(() => window.waitpoint.parts.axis.whole));
});

test('a plot is removed', async () => {
  await page.click('.plot:nth-child(3) button');
  assert.equal((await plots()).length, 2);
});

test('modules: activities, periods, deadlines missed, posters with ages', async () => {
  await page.click('#tab-modules');
  await settle(page);
  const text = await page.$eval('#panel-modules', (panel) => panel.textContent);
  assert.ok(text.includes('ndd GoTo') && text.includes('exec'));
  const bad = await page.$$eval('#panel-modules tr.bad', (rows) =>
    rows.map((row) => [...row.children].map((cell) => cell.textContent))
  );
  assert.deepEqual(bad, [['segloc.slam', '20 ms', '0', '1', '8 ms']]);
  const posters = await page.$$eval('#panel-modules summary', (all) => all.map((summary) => summary.textContent));
  assert.deepEqual(posters, ['pom.position 20 ms old', 'ndd.reference never written', 'rflex.sonars 20 s old']);
});

test("a poster's fields, nested", async () => {
  await page.evaluate(() =>
    [...document.querySelectorAll('#panel-modules details')].forEach((box) => (box.open = true))
  );
  await settle(page);
  const fields = await page.$$eval('#panel-modules details:nth-of-type(3) li', (items) =>
    items.map((item) => item.textContent)
  );
  assert.ok(fields.includes('0 range_m 1.25') && fields.includes('1 range_m 3'));
});

test('the log up to the cursor, and what is to come', async () => {
  await seek(page, 4 * SECOND);
  await page.click('#tab-log');
  await settle(page);
  const lines = await page.$$eval('#panel-log li', (items) =>
    items.map((item) => [item.className.trim(), item.textContent])
  );
  assert.deepEqual(
    lines.map(([kind]) => kind),
    ['', 'bad', 'later']
  );
  await page.click('#panel-log li:nth-child(3) button');
  await settle(page);
  assert.equal(await page.evaluate(() => window.waitpoint.session.time), 5 * SECOND);
});

test('the summary of the run', async () => {
  await page.click('#tab-run');
  await settle(page);
  assert.ok((await page.$eval('#panel-run', (panel) => panel.textContent)).includes('goals reached     3 of 3'));
});
