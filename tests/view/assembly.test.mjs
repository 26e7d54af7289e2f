// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import {test} from 'node:test';
import {fileURLToPath} from 'node:url';
import {assembled} from './browser.mjs';

const sources = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../tools/view/page');

test('the page is one document below 250 KB, without content from elsewhere', () => {
  const page = assembled();
  assert.ok(Buffer.byteLength(page) < 250000, `${Buffer.byteLength(page)} bytes`);
  assert.equal(page.match(/<script/g).length, 1);
  assert.equal(page.match(/<!--run-->/g).length, 1);
  assert.deepEqual(page.match(/https?:\/\/[^\s"']+/g) ?? [], []);
  assert.doesNotMatch(page, /@import|\bsrc=|innerHTML|insertAdjacentHTML|document\.write/);
});

test('every script is in the list, and begins with the licence', () => {
  const listed = fs.readFileSync(path.join(sources, 'scripts.txt'), 'utf8').trim().split('\n');
  const there = fs.readdirSync(sources).filter((name) => name.endsWith('.js'));
  assert.deepEqual([...listed].sort(), there.sort());
  for (const name of there) {
    const text = fs.readFileSync(path.join(sources, name), 'utf8');
    assert.match(text, /^\/\/ SPDX-License-Identifier: BSD-3-Clause\n/);
    assert.ok(text.split('\n').length <= 251, name);
  }
});
