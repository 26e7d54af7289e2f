// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, seek, settle, shareOf} from './browser.mjs';
import {crowdPose, SECOND, sampleRun} from './sample_run.mjs';

let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(sampleRun({robots: 1000, seconds: 5}), 'crowd.html'));
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

test('a thousand robots are where the run says', async () => {
  await seek(page, 2 * SECOND);
  const colours = await page.evaluate(() => window.waitpoint.theme.colours.robots);
  for (const index of [1, 39, 500, 777, 999]) {
    const [x, y] = crowdPose(index, 2),
      at = await page.evaluate((u, v) => window.waitpoint.pixels(u, v), x, y);
    assert.ok(
      (await shareOf(page, '#plan-canvas', colours[index % 8], at.x - 4, at.y - 4, 8, 8)) > 0.2,
      `robot ${index}`
    );
  }
});

test('close by, robots have their shapes', async () => {
  await page.evaluate(() => window.waitpoint.session.selectRobot(500));
  await page.keyboard.press('f');
  await settle(page);
  assert.ok((await page.evaluate(() => window.waitpoint.parts.camera.scale)) * 0.1 >= 15);
  await page.keyboard.press('f');
  await page.click('#fit');
});

test('the pictures a second of a thousand robots', async (context) => {
  const measured = await page.evaluate(async () => {
    const {clock, pictures} = window.waitpoint;
    await clock.seek(0);
    clock.play();
    await new Promise((resolve) => setTimeout(resolve, 500));
    const count = pictures.count,
      begin = performance.now();
    await new Promise((resolve) => setTimeout(resolve, 3000));
    clock.pause();
    return {rate: ((pictures.count - count) / (performance.now() - begin)) * 1000, cost: pictures.cost};
  });
  context.diagnostic(`${measured.rate.toFixed(1)} pictures a second, ${measured.cost.toFixed(1)} ms each in scripts`);
  // How fast depends on the machine and its load; that it goes on does not.
  assert.ok(measured.rate > 0);
});

test('lanes of robots that are not selected are closed', async () => {
  assert.ok((await page.$$eval('.lane-label', (labels) => labels.length)) < 60);
});
