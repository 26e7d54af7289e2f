// SPDX-License-Identifier: BSD-3-Clause
// Branches of a live run, with interventions.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {seek, settle, shareOf} from './browser.mjs';
import {open, page, program, text, until} from './live_page.mjs';
import {poseAt, SECOND} from './sample_run.mjs';

test('a branch with interventions is made, shown and compared', async () => {
  await open();
  await seek(page, 3 * SECOND);
  await page.keyboard.press('b');
  await page.click('#panel-lines .row button:not(.primary)'); // Show: nothing changes
  await page.evaluate(() =>
    [...document.querySelectorAll('#panel-lines button')].find((button) => button.textContent === 'Add').click()
  );
  const line = await page.$eval('#panel-lines textarea', (area) => area.value),
    [x, y] = poseAt(3);
  assert.equal(line, `move ada ${x.toFixed(2)} ${y.toFixed(2)} 0`);
  await page.type('[aria-label="Seed from here on"]', '7');
  await page.click('#panel-lines .primary');
  await until(() => window.waitpoint.session.line === 1);
  assert.deepEqual(
    program.asked.find(({ask}) => ask === 'branch'),
    {ask: 'branch', line: 0, time: 3 * SECOND, interventions: ['seed 7', line]}
  );
  await settle(page);
  await page.click('[aria-label="Line 0 beside"]');
  await until(() => window.waitpoint.session.compared?.difference);
  await settle(page);
  assert.match(await text('.difference'), /Event 2 313 at 2\.002200000 s.*line 1.*resume.*line 0.*unlock/);
  assert.ok(!(await page.$eval('#plan-beside', (plan) => plan.hidden)));
  assert.equal((await page.$$('.lanes-of')).length, 2);
  // The robot is half a metre further up in the branch.
  const [colour] = await page.evaluate(() => window.waitpoint.theme.colours.robots),
    place = poseAt(3);
  const at = await page.evaluate((u, v) => window.waitpoint.pixels(u, v), place[0], place[1]),
    up = await page.evaluate((u, v) => window.waitpoint.pixels(u, v), place[0], place[1] + 0.5);
  assert.ok((await shareOf(page, '#plan-canvas', colour, up.x - 8, up.y - 8, 16, 10)) > 0.1);
  assert.ok((await shareOf(page, '#plan-canvas-beside', colour, at.x - 8, at.y - 2, 16, 10)) > 0.1);
  await page.click('[aria-label="Journal of line 1"]');
  await until(() => document.getElementById('panel-lines').textContent.includes('--replay-journal branch.journal'));
  assert.deepEqual(page.problems, []);
});

test('fields that are filled in but not added are an intervention', async () => {
  await open();
  await seek(page, 3 * SECOND);
  await page.keyboard.press('b');
  await page.$eval('[aria-label="x in m"]', (field) => (field.value = ''));
  await page.type('[aria-label="x in m"]', '4.5');
  await page.click('#panel-lines .primary');
  await until(() => window.waitpoint.session.line === 1);
  const {interventions} = program.asked.find(({ask}) => ask === 'branch');
  assert.deepEqual(interventions, [`move ada 4.5 ${poseAt(3)[1].toFixed(2)} 0`]);
});

test('an intervention that the program rejects is told', async () => {
  await open();
  await seek(page, 3 * SECOND);
  await page.keyboard.press('b');
  await page.type('#panel-lines textarea', 'fly ada');
  await page.click('#panel-lines .primary');
  await until(() => document.querySelector('#panel-lines [role=status]').textContent === "unknown intervention 'fly'");
});

test('without control there are no branches', async () => {
  await open({control: false});
  await page.click('#tab-lines');
  await settle(page);
  assert.ok(await page.$eval('#panel-lines .primary', (button) => button.disabled));
});
