// SPDX-License-Identifier: BSD-3-Clause
// A page of a live run, for each test of a file; closed after it.
import {after, afterEach, before} from 'node:test';
import {launch, openPage} from './browser.mjs';
import {LiveProgram} from './live_program.mjs';

export let browser, program, page;
before(async () => (browser = await launch()));
after(() => browser.close());
afterEach(async () => {
  await page?.close();
  await program?.close();
  page = program = null;
});

export async function open(options) {
  program = new LiveProgram(options);
  await program.listen();
  page = await openPage(browser, program.address);
}
export const text = (selector) => page.$eval(selector, (element) => element.textContent);
export const until = (condition, ...values) => page.waitForFunction(condition, {timeout: 10000}, ...values);
