// SPDX-License-Identifier: BSD-3-Clause
// The page with real runs: of the program that WAITPOINT_PROGRAM names, which has the page within it.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';
import {launch, openPage, seek, settle, shareOf} from './browser.mjs';

const program = process.env.WAITPOINT_PROGRAM,
  skip = program ? false : 'WAITPOINT_PROGRAM names no program';
const scenario = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../scenarios/office.yaml');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'waitpoint-view-program-'));
const RUN = ['run', scenario, '--until', '20'];

/** A run whose goals are not all reached by then ends with status 1, which is as it should be. */
function run(...more) {
  try {
    return execFileSync(program, [...RUN, ...more], {
      cwd: folder,
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'ignore']
    });
  } catch (error) {
    if (error.status !== 1) throw error;
    return error.stdout;
  }
}

let browser, output, truth;
before(async () => {
  if (!program) return;
  browser = await launch();
  output = run('--page', 'run.html', '--trajectory', 'run.tum');
  truth = fs
    .readFileSync(path.join(folder, 'run.tum'), 'utf8')
    .trim()
    .split('\n')
    .map((line) => line.split(' ').map(Number));
});
after(async () => {
  await browser?.close();
  fs.rmSync(folder, {recursive: true, force: true});
});

const digestIn = (text) => /wp1:[0-9a-f]+/.exec(text)[0];

/**
 * The robot in the table is where the trajectory has it; places of the trajectory between two instants are
 * interpolated.
 */
async function isAt(page, seconds) {
  // Close by, where the robot is larger than what is drawn about it.
  await page.evaluate(() => {
    window.waitpoint.session.follow(true);
    window.waitpoint.parts.camera.scale = 60;
  });
  await seek(page, seconds * 1e9);
  const next = truth.findIndex(([time]) => time >= seconds),
    [t0, x0, y0] = truth[next - 1],
    [t1, x1, y1] = truth[next];
  const part = (seconds - t0) / (t1 - t0),
    wanted = [x0 + (x1 - x0) * part, y0 + (y1 - y0) * part];
  const [x, y] = await page.evaluate(() => window.waitpoint.session.frame.robots[0].truth);
  assert.ok(Math.hypot(x - wanted[0], y - wanted[1]) < 0.02, `at ${seconds} s: ${[x, y]}, not ${wanted}`);
  const at = await page.evaluate((u, v) => window.waitpoint.pixels(u, v), x, y),
    [colour] = await page.evaluate(() => window.waitpoint.theme.colours.robots);
  assert.ok(
    (await shareOf(page, '#plan-canvas', colour, at.x - 14, at.y - 14, 28, 28)) > 0.05,
    `drawn at ${seconds} s`
  );
}

test('a recorded run shows the robot where its trajectory has it', {skip}, async () => {
  const page = await openPage(browser, pathToFileURL(path.join(folder, 'run.html')).href);
  for (const seconds of [1, 7.5, 13, 19]) await isAt(page, seconds);
  await page.click('#tab-run');
  await settle(page);
  const text = await page.$eval('#panel-run', (panel) => panel.textContent);
  assert.ok(text.includes(digestIn(output)));
  await page.keyboard.press('End');
  await settle(page);
  const events = await page.evaluate(() => window.waitpoint.session.frame.events);
  assert.equal(events, Number(/events +(\d+)/.exec(output)[1]));
  assert.deepEqual(page.problems, []);
  await page.close();
});

test('a served run shows the same, steps, and has branches', {skip}, async () => {
  const served = spawn(program, [...RUN, '--serve', '--serve-control'], {
    cwd: folder,
    stdio: ['ignore', 'pipe', 'pipe']
  });
  let said = '';
  const address = await new Promise((resolve) => {
    for (const stream of [served.stdout, served.stderr])
      stream.on('data', (data) => {
        said += data;
        const found = /http:\/\/\S+token=\S+/.exec(said);
        if (found) resolve(found[0]);
      });
  });
  try {
    const page = await openPage(browser, address);
    await page.waitForFunction(() => window.waitpoint.session.source.status.over, {timeout: 60000});
    assert.equal(await page.evaluate(() => window.waitpoint.session.source.status.digest), digestIn(output));
    for (const seconds of [13, 7.5]) await isAt(page, seconds);
    const first = await page.evaluate(() => window.waitpoint.session.frame.events);
    await page.evaluate(() => window.waitpoint.clock.step(3));
    assert.equal(await page.evaluate(() => window.waitpoint.session.frame.events), first + 3);
    await page.evaluate(() => window.waitpoint.parts.axis.set(7.49e9, 7.53e9));
    await page.waitForFunction(() => window.waitpoint.parts.timeline.places !== null, {timeout: 60000});
    await page.keyboard.press('b');
    await page.type('#panel-lines textarea', 'move rackham 21 4.5 45');
    await page.click('#panel-lines .primary');
    await page.waitForFunction(() => window.waitpoint.session.line === 1, {timeout: 60000});
    await seek(page, 8e9);
    const [x, y] = await page.evaluate(() => window.waitpoint.session.frame.robots[0].truth);
    assert.ok(Math.hypot(x - 21, y - 4.5) < 1.5, `${[x, y]}`);
    assert.deepEqual(page.problems, []);
    await page.close();
  } finally {
    served.kill('SIGINT');
    await new Promise((resolve) => served.on('exit', resolve));
  }
});
