// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {colourAt, launch, openPage, recordedPage, seek, settle, shareOf} from './browser.mjs';
import {poseAt, SECOND, sampleRun} from './sample_run.mjs';

const CANVAS = '#plan-canvas';
let browser, page;
before(async () => {
  browser = await launch();
  page = await openPage(browser, recordedPage(sampleRun()));
});
after(async () => {
  await browser.close();
  assert.deepEqual(page.problems, []);
});

const pixels = (x, y) => page.evaluate((u, v) => window.waitpoint.pixels(u, v), x, y);
const colours = () => page.evaluate(() => window.waitpoint.theme.colours);

/** The part of a square about a place, of two metres, that has the colour. */
async function shareAbout(x, y, colour, size = 40) {
  const at = await pixels(x, y);
  return shareOf(page, CANVAS, colour, at.x - size / 2, at.y - size / 2, size, size);
}

test('robots are drawn where the run says', async () => {
  const {
    robots: [blue]
  } = await colours();
  for (const seconds of [0, 2.5, 7.3, 12.1, 19.9]) {
    await seek(page, seconds * SECOND);
    const [x, y] = poseAt(seconds);
    const share = await shareAbout(x, y, blue);
    assert.ok(share > 0.05, `${share} at ${seconds} s`);
    assert.ok((await shareAbout(12 - x, 8 - y, blue)) < 0.02, `nothing opposite at ${seconds} s`);
  }
});

test('poses between two frames are interpolated', async () => {
  await seek(page, 2.55 * SECOND);
  const [x, y] = await page.evaluate(() => window.waitpoint.session.frame.robots[0].truth);
  const [wantedX, wantedY] = poseAt(2.55);
  assert.ok(Math.hypot(x - wantedX, y - wantedY) < 1e-9);
});

test('walls, furniture and obstacles that are not on the map differ', async () => {
  await seek(page, 0);
  const {wall, furniture, unknownLine} = await colours();
  assert.ok((await shareAbout(0.1, 4, wall, 4)) > 0.9);
  assert.ok((await shareAbout(5, 4, furniture, 20)) > 0.9);
  assert.ok((await shareAbout(10, 4, unknownLine, 24)) > 0.1);
});

test('layers are switched on and off', async () => {
  await seek(page, 2 * SECOND);
  const {unknownLine, sonar} = await colours();
  const toggle = async (name) => {
    if (await page.$eval('#layer-menu', (menu) => menu.hidden)) await page.click('#layers');
    await page.evaluate(
      (wanted) =>
        [...document.querySelectorAll('#layer-menu label')].find((label) => label.textContent.includes(wanted)).click(),
      name
    );
    await settle(page);
  };
  assert.ok((await shareAbout(10, 4, unknownLine, 24)) > 0.1);
  await toggle('not on the map');
  assert.equal(await shareAbout(10, 4, unknownLine, 24), 0);
  await toggle('not on the map');
  const before = await page.evaluate(() => window.waitpoint.session.layers.sonar);
  await toggle('Sonars');
  assert.equal(await page.evaluate(() => window.waitpoint.session.layers.sonar), !before);
  const [x, y] = poseAt(2),
    at = await pixels(x, y + 2);
  assert.ok((await shareOf(page, CANVAS, sonar, at.x - 60, at.y - 60, 120, 120)) > 0);
  await toggle('Sonars');
  await page.click('#layers');
});

test('the wheel zooms about the pointer', async () => {
  await page.click('#fit');
  // Pointers have whole pixels.
  const place = {x: Math.round((await pixels(8, 6)).x), y: Math.round((await pixels(8, 6)).y)},
    under = await page.evaluate(({x, y}) => window.waitpoint.parts.camera.place(x, y), place),
    box = await page.$eval(CANVAS, (canvas) => ({
      x: canvas.getBoundingClientRect().x,
      y: canvas.getBoundingClientRect().y
    }));
  await page.mouse.move(box.x + place.x, box.y + place.y);
  const scale = await page.evaluate(() => window.waitpoint.parts.camera.scale);
  await page.mouse.wheel({deltaY: -480});
  await settle(page);
  assert.ok(Math.abs((await page.evaluate(() => window.waitpoint.parts.camera.scale)) / scale - 4) < 0.01);
  const after = await pixels(under.x, under.y);
  assert.ok(Math.hypot(after.x - place.x, after.y - place.y) < 2, JSON.stringify([place, after, box]));
  assert.match(
    await page.$eval('#pointer', (output) => output.textContent),
    /^\(8\.0\d, 6\.0\d\) m|^\(7\.9\d, 5\.9\d\) m|^\(8\.0\d, 5\.9\d\) m|^\(7\.9\d, 6\.0\d\) m/
  );
  await page.click('#fit');
});

test('a drag pans, and keys do', async () => {
  await settle(page);
  const before = await pixels(6, 4),
    box = await page.$eval(CANVAS, (canvas) => ({
      x: canvas.getBoundingClientRect().x,
      y: canvas.getBoundingClientRect().y
    }));
  await page.mouse.move(box.x + 300, box.y + 300);
  await page.mouse.down();
  await page.mouse.move(box.x + 350, box.y + 280, {steps: 5});
  await page.mouse.up();
  const moved = await pixels(6, 4);
  assert.ok(Math.hypot(moved.x - before.x - 50, moved.y - before.y + 20) < 8);
  await page.focus(CANVAS);
  await page.keyboard.press('ArrowLeft');
  assert.ok(Math.abs((await pixels(6, 4)).x - moved.x - 60) < 0.01);
  await page.keyboard.press('0');
});

test('the followed robot stays in the middle', async () => {
  await page.keyboard.press('f');
  for (const seconds of [1, 6, 11]) {
    await seek(page, seconds * SECOND);
    const [x, y] = poseAt(seconds),
      at = await pixels(x, y),
      size = await page.$eval(CANVAS, (canvas) => [canvas.clientWidth, canvas.clientHeight]);
    assert.ok(Math.hypot(at.x - size[0] / 2, at.y - size[1] / 2) < 1);
  }
  await page.keyboard.press('f');
  await page.click('#fit');
});

test('distances are measured', async () => {
  await page.keyboard.press('m');
  const from = await pixels(2, 2),
    to = await pixels(5, 6),
    box = await page.$eval(CANVAS, (canvas) => ({
      x: canvas.getBoundingClientRect().x,
      y: canvas.getBoundingClientRect().y
    }));
  await page.mouse.move(box.x + from.x, box.y + from.y);
  await page.mouse.down();
  await page.mouse.move(box.x + to.x, box.y + to.y, {steps: 4});
  await page.mouse.up();
  const {from: a, to: b} = await page.evaluate(() => window.waitpoint.parts.plan.measure);
  assert.ok(Math.abs(Math.hypot(b.x - a.x, b.y - a.y) - 5) < 0.05);
  assert.match(await page.$eval('#pointer', (output) => output.textContent), /^(4\.9|5\.0)\d+ m, 5\d\.\d°$/);
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => window.waitpoint.parts.plan.measure), null);
});

test('the oblique view has heights', async () => {
  await seek(page, 0);
  await page.keyboard.press('v');
  await settle(page);
  const foot = await page.evaluate(() => window.waitpoint.pixels(6, 8, 0)),
    head = await page.evaluate(() => window.waitpoint.pixels(6, 8, 2.6));
  assert.ok(foot.y - head.y > 20);
  const beside = await page.evaluate(() => window.waitpoint.theme.colours.outside);
  const wall = await colourAt(page, CANVAS, (foot.x + head.x) / 2, (foot.y + head.y) / 2);
  assert.notDeepEqual(
    wall,
    [1, 3, 5].map((i) => parseInt(beside.slice(i, i + 2), 16))
  );
  await page.keyboard.press('v');
});

test('the table of robots has the poses in text', async () => {
  await seek(page, 7 * SECOND);
  const cells = await page.$$eval('#panel-robots tbody tr:first-child > *', (all) =>
    all.map((cell) => cell.textContent)
  );
  const [x, y] = poseAt(7);
  assert.deepEqual(cells.slice(0, 5), ['ada', x.toFixed(3), y.toFixed(3), '90.0°', '1 of 3']);
});

test('texts of the run are never markup', async () => {
  await page.keyboard.press('1');
  assert.ok((await page.$eval('#panel-robots', (panel) => panel.textContent)).includes('<b>west</b>'));
  await page.click('#tab-log');
  await settle(page);
  assert.ok((await page.$eval('#panel-log', (panel) => panel.textContent)).includes('<img src=x'));
  assert.equal(await page.$('#panel-log img'), null);
  await page.click('#tab-robots');
});
