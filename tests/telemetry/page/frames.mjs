// SPDX-License-Identifier: BSD-3-Clause
// Processor time of the page of strainwave-telemetry in Chromium. Started by frames_check.
//
//   node frames.mjs URL
import {obey, openPage, rowsOf, say, sleep, until} from './browser.mjs';

const [, , url] = process.argv;
const page = await openPage(url);

/** Milliseconds of the page's main thread for one state and for one redraw, from Chromium's trace. Time of other programs does not count. */
function workOf(traceEvents) {
  const of = (name, tid) => traceEvents.filter((event) => event.name === name && event.tid === tid);
  const renderers = traceEvents.filter(({name, args}) => name === 'thread_name' && args.name === 'CrRendererMain').map(({tid}) => tid);
  const main = renderers.find((tid) => of('WebSocketReceive', tid).length > 0); // the other renderers are spare
  const tasks = of('RunTask', main).filter(({tdur}) => tdur > 0);
  const sum_ms = (list) => list.reduce((sum, {tdur}) => sum + tdur / 1000, 0);
  // A redraw is a timer's script and the tasks that bring its picture to the screen.
  const begins_us = ['TimerFire', 'Commit', 'Paint'].flatMap((name) => of(name, main)).map(({ts}) => ts);
  const drawing_ms = sum_ms(tasks.filter(({ts, dur}) => begins_us.some((begin_us) => begin_us >= ts && begin_us <= ts + dur)));
  const [states, redraws] = ['WebSocketReceive', 'TimerFire'].map((name) => of(name, main).length);
  return {states, redraws, state_ms: (sum_ms(tasks) - drawing_ms) / states, redraw_ms: drawing_ms / redraws};
}

const steps = {
  async joints(count) {
    await until(async () => (await rowsOf(page)).length >= Number(count), 20);
    say({joints: (await rowsOf(page)).length});
  },
  async work(seconds) {
    await page.tracing.start({categories: ['devtools.timeline', 'disabled-by-default-devtools.timeline', '__metadata']});
    await sleep(Number(seconds));
    say(workOf(JSON.parse(new TextDecoder().decode(await page.tracing.stop())).traceEvents));
  },
};
await obey(steps);
