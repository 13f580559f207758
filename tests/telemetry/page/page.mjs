// SPDX-License-Identifier: BSD-3-Clause
// Before the page of strainwave-telemetry, in Chromium: numbers, plots, a fault, recordings, hostile names, keys, small screens, accessibility.
// Talks to its parent: prints a line of JSON for each answer, and reads one word a line.
//
//   node page.mjs URL RECORDING-CSV RECORDING-MCAP HOSTILE-CSV SCREENSHOT-FOLDER
import fs from 'node:fs';
import readline from 'node:readline';
import axe from 'axe-core';
import puppeteer from 'puppeteer-core';

const [, , url, csv, mcap, hostile, pictures] = process.argv;
const say = (value) => console.log(JSON.stringify(value));
const browser = await puppeteer.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu']});
const page = await browser.newPage();
const problems = [];
page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
page.on('pageerror', (error) => problems.push(error.message));
page.on('dialog', (dialog) => {
  problems.push(`a dialog opened: ${dialog.message()}`);
  dialog.dismiss();
});
await page.setViewport({width: 1280, height: 900});
await page.goto(url);

const rows = () => page.$$eval('#joints tr', (list) => list.map((row) => [...row.cells].map((cell) => cell.textContent)));
const cell = async (joint, column) => (await rows()).find((row) => row[0] === joint)?.[column];
async function until(condition, seconds) {
  const begin = Date.now();
  while (Date.now() - begin < 1000 * seconds) {
    if (await condition()) return (Date.now() - begin) / 1000;
    await new Promise((go) => setTimeout(go, 20));
  }
  return null;
}
// Pixels of the plots' areas in the colour of a curve: neither ground nor grid nor text, which are grey.
const curvePixels = () => page.$$eval('#plots canvas', (list) => list.map((canvas) => {
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let coloured = 0;
  for (let i = 0; i < data.length; i += 4) {
    const spread = Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]);
    if (data[i + 3] > 128 && spread > 60) ++coloured;
  }
  return coloured;
}));
async function upload(file) {
  const input = await page.$('#file');
  await input.uploadFile(file);
}
const text = (selector) => page.$eval(selector, (element) => element.textContent);

const steps = {
  async joint() {
    await until(async () => (await rows()).length > 0, 10);
    say({rows: await rows()});
  },
  async plots() {
    await page.keyboard.press('1'); // ten seconds
    await new Promise((go) => setTimeout(go, 3000));
    await page.screenshot({path: `${pictures}/page.png`});
    say({pixels: await curvePixels()});
  },
  async fault() { say({seconds: await until(async () => (await cell('elbow', 7))?.includes('fault 4: supply lost'), 5), words: await cell('elbow', 7)}); },
  async keys() {
    const before = await text('#pause');
    await page.keyboard.press('p');
    const paused = await text('#pause');
    await page.keyboard.press('p');
    await page.keyboard.press('3');
    say({before, paused, span: await page.$eval('#span', (select) => select.value)});
  },
  async recordings() {
    const seen = {};
    for (const [kind, file] of Object.entries({csv, mcap})) {
      await upload(file);
      await until(async () => (await text('#connection')).startsWith('recording'), 5);
      seen[kind] = {rows: await rows(), pixels: await curvePixels(), title: await text('#plots-title'), problem: await text('#problem')};
      await page.click('#live');
    }
    say(seen);
  },
  async hostile() {
    await upload(hostile);
    await until(async () => (await text('#connection')).startsWith('recording'), 5);
    const elements = await page.$$eval('main img, main script', (list) => list.length);
    say({names: (await rows()).map((row) => row[0]), elements});
    await page.click('#live');
  },
  async nonsense() {
    fs.writeFileSync(`${pictures}/nonsense.csv`, 'a,b\n1,2\n');
    await upload(`${pictures}/nonsense.csv`);
    await until(async () => (await text('#problem')) !== '', 5);
    say({problem: await text('#problem'), connection: await text('#connection')});
  },
  async accessibility() {
    const found = {};
    for (const scheme of ['light', 'dark']) {
      await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
      // By the browser's debugger, which the page's policy does not bind.
      await page.evaluate(axe.source);
      const {violations} = await page.evaluate(() => axe.run());
      found[scheme] = violations.map(({id, nodes}) => `${id}: ${nodes.map((node) => node.html).slice(0, 3).join(' ')}`);
    }
    say(found);
  },
  async small() {
    await page.setViewport({width: 360, height: 800});
    await new Promise((go) => setTimeout(go, 300));
    say({width: await page.evaluate(() => document.documentElement.scrollWidth)});
  },
  async problems() { say({problems}); },
  async memory() {
    const client = await page.createCDPSession();
    await client.send('HeapProfiler.collectGarbage');
    const {usedSize} = await client.send('Runtime.getHeapUsage');
    say({used_MB: usedSize / 1e6, joints: (await rows()).length});
  },
};
for await (const line of readline.createInterface({input: process.stdin})) {
  if (line === 'end') break;
  await steps[line]();
}
await browser.close();
