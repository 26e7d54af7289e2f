// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import {after, before, test} from 'node:test';
import {launch, openPage, recordedPage, settle} from './browser.mjs';
import {SECOND, sampleRun} from './sample_run.mjs';

const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

async function violations(page) {
  const found = await page.evaluate(() => window.axe.run(document, {resultTypes: ['violations']}));
  return found.violations.flatMap(({id, nodes}) =>
    nodes.map((node) => `${id}: ${node.html.slice(0, 120)} ${node.failureSummary}`)
  );
}

for (const dark of [false, true]) {
  test(`axe finds nothing in any part of the page, ${dark ? 'dark' : 'light'}`, async () => {
    const page = await openPage(browser, recordedPage(sampleRun()), {dark});
    await page.evaluate(axe);
    await page.evaluate((time) => window.waitpoint.clock.seek(time), 4 * SECOND);
    for (const tab of await page.$$eval('[role=tab]', (tabs) => tabs.map((one) => one.id))) {
      await page.click(`#${tab}`);
      await page.evaluate(() => document.querySelectorAll('details').forEach((box) => (box.open = true)));
      await settle(page);
      assert.deepEqual(await violations(page), [], tab);
    }
    await page.evaluate(() => window.waitpoint.parts.timelineGestures.select(500));
    await page.click('#layers');
    await settle(page);
    assert.deepEqual(await violations(page), [], 'layers and a selected event');
    await page.click('#layers');
    await page.click('#help');
    await settle(page);
    assert.deepEqual(await violations(page), [], 'keys');
    assert.deepEqual(page.problems, []);
    await page.close();
  });
}

test('all controls are reached with the Tab key, in the order in which they are seen', async () => {
  const page = await openPage(browser, recordedPage(sampleRun()));
  const reached = [];
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press('Tab');
    const id = await page.evaluate(
      () =>
        document.activeElement.id || document.activeElement.getAttribute('aria-label') || document.activeElement.tagName
    );
    if (id === 'BODY' || (reached.length && id === reached[0])) break;
    reached.push(id);
  }
  const order = [
    'theme',
    'help',
    'plan-canvas',
    'fit',
    'layers',
    'split-side',
    'tab-robots',
    'to-begin',
    'play',
    'time',
    'speed',
    'slider',
    'split-lower',
    'lane-filter',
    'show-all'
  ];
  assert.deepEqual(
    reached.filter((id) => order.includes(id)),
    order
  );
  await page.close();
});

test('the plan is told in words', async () => {
  const page = await openPage(browser, recordedPage(sampleRun()));
  await page.evaluate((time) => window.waitpoint.clock.seek(time), 6 * SECOND);
  await new Promise((resolve) => setTimeout(resolve, 1500));
  assert.match(
    await page.$eval('#plan-text', (text) => text.textContent),
    /^At 6 s ada is at \(8\.00, 2\.80\) m, heading 90\.0°, with 1 of 3 goals reached/
  );
  await page.close();
});
