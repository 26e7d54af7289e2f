// SPDX-License-Identifier: BSD-3-Clause
// The page in a browser. The document is assembled from the sources, or is the file that WAITPOINT_PAGE names.

import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import zlib from 'node:zlib';
import puppeteer from 'puppeteer-core';

const here = path.dirname(fileURLToPath(import.meta.url)),
  sources = path.resolve(here, '../../tools/view/page');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'waitpoint-view-'));
process.on('exit', () => fs.rmSync(folder, {recursive: true, force: true}));

export function assembled() {
  if (process.env.WAITPOINT_PAGE) return fs.readFileSync(process.env.WAITPOINT_PAGE, 'utf8');
  const output = path.join(folder, 'page.html'),
    scripts = fs.readFileSync(path.join(sources, 'scripts.txt'), 'utf8').trim().split('\n');
  if (!fs.existsSync(output))
    execFileSync('python3', ['-B', 'assemble.py', output, 'page.html', 'page.css', ...scripts], {cwd: sources});
  return fs.readFileSync(output, 'utf8');
}

/** The document of a recorded run, as a file. */
export function recordedPage(run, name = 'run.html') {
  const data = zlib.gzipSync(JSON.stringify(run)).toString('base64'),
    file = path.join(folder, name);
  fs.writeFileSync(
    file,
    assembled().replace('<!--run-->', () => `<script id="run" type="text/plain">${data}</script>`)
  );
  return pathToFileURL(file).href;
}

export async function launch() {
  return puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu'],
    headless: true
  });
}

/** Opens a document and waits until it shows the run. Errors of its scripts fail the test that awaits `problems`. */
export async function openPage(browser, address, {width = 1440, height = 900, dark = false} = {}) {
  const page = await browser.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  // The tests' own reading of pixels is nothing to warn of.
  page.on(
    'console',
    (message) =>
      ['error', 'warn'].includes(message.type()) &&
      !/readback/.test(message.text()) &&
      page.problems.push(message.text())
  );
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: dark ? 'dark' : 'light'}]);
  await page.setViewport({width, height});
  await page.goto(address);
  await page.waitForSelector('html[data-ready]', {timeout: 30000});
  await settle(page);
  return page;
}

/** Waits until all that is wanted has been painted. */
export async function settle(page) {
  await page.evaluate(
    () => new Promise((resolve) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(resolve)), 200))
  );
}

/** Seeks and paints. */
export async function seek(page, time) {
  await page.evaluate((wanted) => window.waitpoint.clock.seek(wanted), time);
  await settle(page);
}

/** The colour of a pixel of a canvas, as [red, green, blue]; x and y in CSS pixels. */
export async function colourAt(page, selector, x, y) {
  return page.evaluate(
    (found, u, v) => {
      const canvas = document.querySelector(found),
        ratio = canvas.width / canvas.clientWidth;
      return [...canvas.getContext('2d').getImageData(Math.round(u * ratio), Math.round(v * ratio), 1, 1).data].slice(
        0,
        3
      );
    },
    selector,
    x,
    y
  );
}

/** The part of a rectangle's pixels that differ by little from a colour "#rrggbb". */
export async function shareOf(page, selector, colour, x, y, width, height) {
  return page.evaluate(
    (found, wanted, ...box) => {
      const canvas = document.querySelector(found),
        ratio = canvas.width / canvas.clientWidth,
        [u, v, w, h] = box.map((length) => Math.round(length * ratio));
      const pixels = canvas.getContext('2d').getImageData(u, v, w, h).data,
        parts = [1, 3, 5].map((at) => parseInt(wanted.slice(at, at + 2), 16));
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4)
        if (parts.every((part, k) => Math.abs(pixels[i + k] - part) < 70)) ++count;
      return count / (w * h);
    },
    selector,
    colour,
    x,
    y,
    width,
    height
  );
}
