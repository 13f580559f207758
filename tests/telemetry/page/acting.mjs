// SPDX-License-Identifier: BSD-3-Clause
// Orders from the page of strainwave-telemetry, in Chromium. Started by acting_check.
//
//   node acting.mjs SCREENSHOT-FOLDER
import {obey, openPage, problems, rowsOf, say, sleep, until, violationsOf, widthWhenSmall} from './browser.mjs';

const [, , pictures] = process.argv;
const JOG_S = 1;
const SHOWN_S = 0.5; // time until a page that was hidden is up to date
const tabs = {};
const mode = async (tab) => (await rowsOf(tab))[0][1];
const position_rad = async (tab) => Number((await rowsOf(tab))[0][2]);
const answers = (tab) => tab.$$eval('#answers li', (list) => list.map((item) => item.textContent));
const visible = (tab, selector) => tab.$eval(selector, (element) => element.checkVisibility());
const center = async (tab, selector) => {
  await tab.$eval(selector, (element) => element.scrollIntoView({block: 'center'}));
  const {x, y, width, height} = await (await tab.$(selector)).boundingBox();
  return [x + width / 2, y + height / 2];
};
async function press(tab, selector) {
  await tab.mouse.move(...await center(tab, selector));
  await tab.mouse.down();
}
/** Returns how far the joint moved until it held, how long that took, and how far it moves afterwards. */
async function stopped(tab, from_rad, wanted = 'holding') {
  const seconds = await until(async () => await mode(tab) === wanted, 5);
  const rest_rad = await position_rad(tab);
  await sleep(0.7);
  return {moved_rad: rest_rad - from_rad, seconds, drift_rad: await position_rad(tab) - rest_rad, mode: await mode(tab), answers: await answers(tab)};
}

const steps = {
  async open(name, url) {
    const tab = tabs[name] = await openPage(url);
    await until(async () => (await rowsOf(tab)).length > 0 && await tab.$('#stop') !== null, 10);
    await sleep(1.5); // the limits come once a second
    say({panel: await visible(tab, '#orders-panel'), stop: await visible(tab, '#stop'), limits: await tab.$eval('#orders-limits', (element) => element.textContent), hash: new URL(tab.url()).hash});
  },
  async click(name, selector, expected) {
    const tab = tabs[name];
    await tab.bringToFront();
    await tab.click(selector);
    await until(async () => (await answers(tab))[0]?.includes(expected), 5);
    await until(async () => await mode(tab) === 'holding', 2);
    say({answers: await answers(tab), mode: await mode(tab)});
  },
  async release(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    const from_rad = await position_rad(tab);
    await press(tab, '#jog-up');
    await sleep(JOG_S);
    const during = await mode(tab);
    await tab.screenshot({path: `${pictures}/page-orders.png`});
    await tab.mouse.up();
    say({during, ...await stopped(tab, from_rad)});
  },
  // Another page comes to the front while the jog button is held.
  async hide(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    const from_rad = await position_rad(tab);
    await press(tab, '#jog-down');
    await sleep(JOG_S);
    const other = await openPage('about:blank');
    await other.bringToFront();
    await sleep(JOG_S);
    await other.close();
    await tab.bringToFront(); // a hidden page shows nothing new; the button is still held
    await sleep(SHOWN_S);
    const result = await stopped(tab, from_rad);
    await tab.mouse.up();
    say(result);
  },
  // Two tabs jog, and the second one is refused. Then the first one is closed.
  async close(name, url) {
    const first = await openPage(url);
    await until(async () => (await rowsOf(first)).length > 0, 10);
    await sleep(1.5);
    const from_rad = await position_rad(first);
    await press(first, '#jog-up');
    await sleep(JOG_S);
    const tab = tabs[name];
    const refused = await tab.evaluate(async () => {
      document.getElementById('jog-down').dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true}));
      await new Promise((go) => setTimeout(go, 300));
      document.getElementById('jog-down').dispatchEvent(new KeyboardEvent('keyup', {key: 'Enter', bubbles: true}));
      return document.querySelector('#answers li')?.textContent;
    });
    await first.close();
    await sleep(SHOWN_S);
    say({refused, ...await stopped(tab, from_rad)});
  },
  // Keyboard only: Enter jogs, and the space bar stops while Enter is still held.
  async space(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    await tab.focus('#jog-up');
    const from_rad = await position_rad(tab);
    await tab.keyboard.down('Enter');
    await sleep(JOG_S);
    const during = await mode(tab);
    await tab.keyboard.press('Space');
    const result = await stopped(tab, from_rad, 'off');
    await tab.keyboard.up('Enter');
    say({during, ...result});
  },
  // While the plots are paused, the table and the quoted challenge keep updating. A held Enter sends one order.
  async pause(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    await tab.click('#pause');
    await sleep(2.5); // longer than the lifetime of a challenge
    await tab.$eval('#answers', (list) => list.replaceChildren());
    await tab.focus('#enable');
    for (let i = 0; i < 4; ++i) await tab.keyboard.down('Enter');
    await tab.keyboard.up('Enter');
    const seconds = await until(async () => await mode(tab) === 'holding', 3);
    await sleep(0.5);
    await tab.click('#pause');
    say({seconds, answers: await answers(tab)});
  },
  async reload(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    await tab.reload();
    const seconds = await until(async () => await tab.$('#stop') !== null && await visible(tab, '#orders-panel'), 10);
    await sleep(1.5); // the limits come once a second
    say({panel: seconds !== null});
  },
  // strainwave-telemetry is suspended.
  async silence(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    const stops = setInterval(() => tab.keyboard.press('Space'), 300);
    const seconds = await until(async () => (await answers(tab))[0]?.includes('no answer'), 5);
    clearInterval(stops);
    say({seconds, answers: await answers(tab)});
  },
  // Repeats the page's orders on a connection that has not yet sent the token, and then with the token. Also repeats an old order.
  async replay(name) {
    say(await tabs[name].evaluate(async () => {
      const {token} = history.state;
      const socket = new WebSocket(`ws://${location.host}/`, ['foxglove.websocket.v1']);
      const texts = [];
      let state = null;
      socket.binaryType = 'arraybuffer';
      socket.onmessage = ({data}) => {
        if (typeof data !== 'string') {
          state = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 13)));
          return;
        }
        const message = JSON.parse(data);
        if (message.op === 'acted') texts.push(message.text);
        if (message.op !== 'advertise') return;
        for (const {id, topic} of message.channels) if (topic === 'SW.elbow.STATE') socket.send(JSON.stringify({op: 'subscribe', subscriptions: [{id, channelId: id}]}));
      };
      const wait = (ms) => new Promise((go) => setTimeout(go, ms));
      while (state === null) await wait(20);
      const enable = JSON.stringify({op: 'act', action: 'enable', joint: 'SW.elbow', session_id: state.session_id, challenge: state.challenge});
      socket.send(enable);
      await wait(300);
      const without = texts.splice(0);
      socket.send(JSON.stringify({op: 'act', action: 'open', token}));
      await wait(2500);
      socket.send(enable);
      await wait(1000);
      return {without, late: texts};
    }));
  },
  async look(name) {
    const tab = tabs[name];
    await tab.bringToFront();
    const violations = await violationsOf(tab);
    say({violations, width: await widthWhenSmall(tab), stop: await visible(tab, '#stop'), problems});
  },
};
await obey(steps);
