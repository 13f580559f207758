// SPDX-License-Identifier: BSD-3-Clause
// Tests the page of strainwave-telemetry in Chromium: numbers, plots, a fault, recordings, hostile names, keys, small screens, accessibility. The
// parent sends one word a line and gets a line of JSON for each answer.
//
//   node page.mjs URL RECORDING-CSV RECORDING-MCAP HOSTILE-CSV SCREENSHOT-FOLDER
import fs from 'node:fs';
import path from 'node:path';
import {obey, openPage, problems, rowsOf, say, sleep, textOf, until, violationsOf, widthWhenSmall} from './browser.mjs';

const [, , url, csv, mcap, hostile, pictures] = process.argv;
const page = await openPage(url);
const rows = () => rowsOf(page);
const text = (selector) => textOf(page, selector);
const cell = async (joint, column) => (await rows()).find((row) => row[0] === joint)?.[column];
// Counts the pixels of the plots that have a curve's colour. Background, grid and text are grey.
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

const steps = {
  async joint() {
    await until(async () => (await rows()).length > 0, 10);
    say({rows: await rows()});
  },
  async plots() {
    await page.keyboard.press('1'); // shows the last ten seconds
    await sleep(3);
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
  async report(file) {
    await upload(file);
    await until(() => page.$eval('#reports', (list, name) => list.firstElementChild?.textContent.startsWith(`${name}, `), path.basename(file)), 5);
    say(await page.$eval('#reports > details', (report) => ({
      title: report.querySelector('summary').textContent, facts: report.querySelector('p').textContent, rows: [...report.querySelectorAll('tr')].map((row) => [...row.cells].map((cell) => cell.textContent)),
      files: [...report.querySelectorAll('pre')].map((file) => file.textContent), elements: report.querySelectorAll('img, script, style, a, iframe, [id], [onclick], [style]').length,
      curves: report.querySelectorAll('svg path').length, connection: document.getElementById('connection').textContent, problem: document.getElementById('problem').textContent,
    })));
  },
  // The reports that remain after the page is left and opened again.
  async reload() {
    await page.reload();
    await until(async () => (await rows()).length > 0, 10);
    say({titles: await page.$$eval('#reports > details > summary', (list) => list.map((title) => title.textContent)), hidden: await page.$eval('#reports-section', (section) => section.hidden)});
  },
  // Removes the first report.
  async remove() {
    await page.$eval('#reports > details', (report) => { report.open = true; });
    await page.click('#reports > details button');
    say({left: (await page.$$('#reports > details')).length});
  },
  async nonsense() {
    fs.writeFileSync(`${pictures}/nonsense.csv`, 'a,b\n1,2\n');
    await upload(`${pictures}/nonsense.csv`);
    await until(async () => (await text('#problem')) !== '', 5);
    say({problem: await text('#problem'), connection: await text('#connection')});
  },
  async accessibility() { say(await violationsOf(page)); },
  async small() { say({width: await widthWhenSmall(page)}); },
  // A server without a key offers no script for orders and answers no order.
  async orders() {
    const {status} = await fetch(new URL('acting.js', url));
    const answer = await page.evaluate(() => new Promise((done) => {
      const socket = new WebSocket(`ws://${location.host}/`, ['foxglove.websocket.v1']);
      socket.onopen = () => socket.send(JSON.stringify({op: 'act', action: 'stop'}));
      socket.onmessage = ({data}) => typeof data === 'string' && JSON.parse(data).op === 'status' && done(JSON.parse(data).message);
    }));
    say({status, answer, elements: await page.$$eval('#stop, #orders', (list) => list.length)});
  },
  async problems() { say({problems: problems.splice(0)}); },
};
await obey(steps);
