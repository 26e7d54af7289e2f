// SPDX-License-Identifier: BSD-3-Clause
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {test} from 'node:test';
import {fileURLToPath} from 'node:url';
import {assembled} from './browser.mjs';

const sources = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../tools/view/page');

test('the page is one document below 150 KB, without content from elsewhere', () => {
  const page = assembled();
  assert.ok(Buffer.byteLength(page) < 150000, `${Buffer.byteLength(page)} bytes`);
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

test('squeezing keeps what strings, templates and expressions have', () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'waitpoint-squeeze-'));
  const code = [
    'const a = "  // no comment ", b = `x  ${[1, 2].map((i) => `<${i + 1}  ;}`).join(" ; ")}  /* none */`; // gone',
    "const c = 'it''s' + /[/]  \\/;}/.source; /* gone */",
    'let d = 1; d = d + +1 - -d; const e = d / 2 / 1;',
    'const f = (x) => ({x, y: [x, , 3]});',
    'let g = 0; for (let i = 0; i < 3; ) { ++g; i++; }',
    'const h = ((p) => p)(7)',
    'const k = a.length',
    '  ? h',
    '  : g;',
    'result = JSON.stringify([a, b, c, d, e, f(1), g, h, k]);'
  ]
    .join('\n')
    .replace("'it''s'", "'it\\'s'");
  fs.writeFileSync(path.join(folder, 'in.js'), code);
  const program = 'import sys, squeeze; sys.stdout.write(squeeze.squeeze_script(open(sys.argv[1]).read()))';
  const small = execFileSync('python3', ['-B', '-c', program, path.join(folder, 'in.js')], {
    cwd: sources,
    encoding: 'utf8'
  });
  const value = (text) => new Function(`let result; ${text}\nreturn result;`)();
  assert.equal(value(small), value(code));
  assert.ok(!small.includes('gone'));
  assert.ok(small.length < code.length * 0.9);
  fs.rmSync(folder, {recursive: true});
});
