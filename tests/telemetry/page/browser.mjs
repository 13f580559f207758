// SPDX-License-Identifier: BSD-3-Clause
// Debian's Chromium for the tests of the page. The parent sends a word and its arguments a line and gets a line of JSON.
import readline from 'node:readline';
import axe from 'axe-core';
import puppeteer from 'puppeteer-core';

const browser = await puppeteer.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu']});

/** Errors of the page, from its console or a dialog. */
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

/** Waits for `condition`. Returns the seconds that it took, or null after `seconds`. */
export async function until(condition, seconds) {
  const begin = Date.now();
  while (Date.now() - begin < 1000 * seconds) {
    if (await condition()) return (Date.now() - begin) / 1000;
    await sleep(0.02);
  }
  return null;
}

/** Accessibility violations that axe finds, by colour scheme. */
export async function violationsOf(page) {
  const found = {};
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
    // Uses the browser's debugger, to which the page's security policy does not apply.
    await page.evaluate(axe.source);
    const {violations} = await page.evaluate(() => axe.run());
    found[scheme] = violations.map(({id, nodes}) => `${id}: ${nodes.map((node) => node.html).slice(0, 3).join(' ')}`);
  }
  return found;
}

/** The page's width in a window as narrow as a telephone. */
export async function widthWhenSmall(page) {
  await page.setViewport({width: 360, height: 800});
  await sleep(0.3);
  return page.evaluate(() => document.documentElement.scrollWidth);
}

/** Runs the steps that the parent orders, until the parent closes the pipe. */
export async function obey(steps) {
  for await (const line of readline.createInterface({input: process.stdin})) {
    const [step, ...words] = line.split(' ');
    await steps[step](...words);
  }
  await browser.close();
}
