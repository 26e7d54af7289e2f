// SPDX-License-Identifier: BSD-3-Clause
// A search and its finding, served by the program that WAITPOINT_PROGRAM names.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {fileURLToPath} from 'node:url';
import {launch, openPage, settle} from './browser.mjs';

const axe = fs.readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const program = process.env.WAITPOINT_PROGRAM,
  skip = program ? false : 'WAITPOINT_PROGRAM names no program';
const scenario = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../scenarios/office.yaml');

let browser;
before(async () => {
  if (program) browser = await launch();
});
after(() => browser?.close());

/** A search with the address of its page; end() stops it and gives its output. */
async function search(...options) {
  const started = spawn(program, ['explore', scenario, '--serve', ...options], {stdio: ['ignore', 'pipe', 'pipe']}),
    ended = new Promise((resolve) => started.on('close', resolve));
  let output = '';
  started.stdout.on('data', (part) => (output += part));
  const url = await new Promise((resolve, reject) => {
    let errors = '';
    started.stderr.on('data', (part) => {
      errors += part;
      const found = /http:\S+/.exec(errors);
      if (found) resolve(found[0]);
    });
    started.on('close', () => reject(new Error(errors)));
  });
  const end = async () => {
    started.kill('SIGINT');
    return {status: await ended, output};
  };
  return {url, end};
}

test('the page of a search turns into that of its finding, with the floor of both runs', {skip}, async () => {
  const {url, end} = await search('--until', '25', '--property', 'position_error_max_m=0.018', '--jobs', '2');
  const page = await openPage(browser, url);
  await page.waitForSelector('html[data-ready] .headline', {timeout: 60000});
  await settle(page);
  const shown = await page.evaluate(() => ({
    headline: document.querySelector('.headline').textContent,
    replay: document.querySelector('.command').textContent,
    plans: [...document.querySelectorAll('#plans .plan')].filter((plan) => !plan.hidden).length,
    lanes: document.querySelectorAll('.lanes-of').length,
    time: window.waitpoint.session.time,
    robots: window.waitpoint.session.frame.robots.length
  }));
  assert.deepEqual(page.problems, []);
  const {status, output} = await end();
  assert.equal(status, 1);
  assert.ok(output.includes(`failed at`) && output.includes(shown.headline), output);
  assert.ok(output.includes(`replay: ${shown.replay}\n`), `${shown.replay}\n${output}`);
  assert.deepEqual([shown.plans, shown.lanes, shown.robots], [2, 2, 1]);
  assert.ok(shown.time > 15e9, 'the instant of the failure');
});

test('while it goes, the page tells how many schedules were tried', {skip}, async () => {
  const {url, end} = await search('--until', '2', '--set', 'expect={}', '--iterations', '100000');
  const page = await openPage(browser, url);
  const count = async () => Number((await page.$eval('#search tbody td', (cell) => cell.textContent)).replace(/\D/g, ''));
  await page.waitForFunction(() => document.querySelector('#search tbody td')?.textContent > '0', {timeout: 60000});
  const before = await count();
  await page.waitForFunction(
    (least) => Number(document.querySelector('#search tbody td').textContent.replace(/\D/g, '')) > least,
    {timeout: 60000},
    before
  );
  assert.match(await page.$eval('#connection', (state) => state.textContent), /^connected$/);
  await page.evaluate(axe);
  const {violations} = await page.evaluate(() => window.axe.run(document, {resultTypes: ['violations']}));
  assert.deepEqual(violations.flatMap(({id, nodes}) => nodes.map((node) => `${id}: ${node.html.slice(0, 120)}`)), []);
  assert.equal((await end()).status, 130);
  assert.deepEqual(page.problems, []);
});
