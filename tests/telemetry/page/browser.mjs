// SPDX-License-Identifier: BSD-3-Clause
// Debian's Chromium for the tests of the page, and the conversation with their parent: a word and its arguments a line, answered by a line of JSON.
import readline from 'node:readline';
import axe from 'axe-core';
import puppeteer from 'puppeteer-core';

const browser = await puppeteer.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu']});

/** What the console, or a dialog, complained of. */
export const problems = [];

export async function openPage(url) {
  const page = await browser.newPage();
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  page.on('pageerror', (error) => problems.push(error.message));
  page.on('dialog', (dialog) => {
    problems.push(`a dialog opened: ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.setViewport({width: 1280, height: 900});
  await page.goto(url);
  return page;
}

export const sleep = (seconds) => new Promise((go) => setTimeout(go, 1000 * seconds));
export const say = (value) => console.log(JSON.stringify(value));
export const rowsOf = (page) => page.$$eval('#joints tr', (list) => list.map((row) => [...row.cells].map((cell) => cell.textContent)));
export const textOf = (page, selector) => page.$eval(selector, (element) => element.textContent);

/** Seconds until `condition`, or null. */
export async function until(condition, seconds) {
  const begin = Date.now();
  while (Date.now() - begin < 1000 * seconds) {
    if (await condition()) return (Date.now() - begin) / 1000;
    await sleep(0.02);
  }
  return null;
}

/** What axe finds, by colour scheme. */
export async function violationsOf(page) {
  const found = {};
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
    // By the browser's debugger, which the page's policy does not bind.
    await page.evaluate(axe.source);
    const {violations} = await page.evaluate(() => axe.run());
    found[scheme] = violations.map(({id, nodes}) => `${id}: ${nodes.map((node) => node.html).slice(0, 3).join(' ')}`);
  }
  return found;
}

/** The page's width where the window is as narrow as a telephone. */
export async function widthWhenSmall(page) {
  await page.setViewport({width: 360, height: 800});
  await sleep(0.3);
  return page.evaluate(() => document.documentElement.scrollWidth);
}

/** Does what the parent says until it closes its end. */
export async function obey(steps) {
  for await (const line of readline.createInterface({input: process.stdin})) {
    const [step, ...words] = line.split(' ');
    await steps[step](...words);
  }
  await browser.close();
}
