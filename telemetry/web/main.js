// SPDX-License-Identifier: BSD-3-Clause
// The page: joints of all daemons live, or of a recording, as a table and as plots of the chosen one.
import {Connection, jointOf} from './connection.js';
import {History, valuesOf} from './history.js';
import {Plots} from './plots.js';
import {readRecording} from './recording.js';
import {Reports} from './reports.js';
import {JointTable} from './table.js';

const REDRAW_MS = 100;
const SILENT_S = 10; // after this silence a joint counts as gone
const element = (id) => document.getElementById(id);

const live = new Map(); // joint to {history, channel, last, received_s, limits}
let recording = null; // result of readRecording(); null: live
let chosen = null;
let pausedAt_s = null;
let zoom = null; // [from_s, to_s]
let actingAsked = false;
let acting = null; // the Acting object, if the server takes orders
let vocabulary = {faults: {}, notices: {}};

const joints = () => recording ?? live;
const now_s = () => Date.now() / 1000;

function words(state) {
  const list = [];
  if (state.fault > 0) {
    const {text, key} = vocabulary.faults[state.fault] ?? {text: state.fault_text ?? 'unknown'};
    list.push(`fault ${state.fault}: ${text}${key ? ` (${key})` : ''}`);
  }
  for (const [bit, {text}] of Object.entries(vocabulary.notices)) if (state.notices & Number(bit)) list.push(text);
  return list;
}

function choose(name) {
  chosen = name;
  zoom = null;
  table.choose(name);
  redraw();
}

function span() {
  const joint = joints().get(chosen);
  if (zoom) return zoom;
  if (recording) return [joint.from_s, Math.max(joint.to_s, joint.from_s + 1e-3)];
  const to_s = pausedAt_s ?? now_s();
  return [to_s - Number(element('span').value), to_s];
}

function showJoints() {
  element('empty').hidden = joints().size > 0;
  for (const [name, joint] of joints()) table.show(name, joint.last, words(joint.last), recording ? 0 : now_s() - joint.received_s);
  acting?.show();
}

function redraw() {
  showJoints();
  const joint = joints().get(chosen);
  element('plots-title').textContent = joint ? `Plots of ${chosen}` : 'Plots';
  if (joint) plots.show(joint.history, ...span(), joint.fault_s ?? null);
}

/** Keeps the chosen joint, because its last plots may show the cause. */
function forgetSilent() {
  for (const [name, {received_s}] of live) {
    if (name === chosen || now_s() - received_s < SILENT_S) continue;
    live.delete(name);
    if (!recording) table.remove(name);
  }
}

function setPaused(paused) {
  pausedAt_s = paused ? now_s() : null;
  if (!paused) zoom = null;
  element('pause').setAttribute('aria-pressed', String(paused));
  element('pause').textContent = paused ? 'Go on' : 'Pause';
  redraw();
}

function complain(text) {
  element('problem').hidden = text === '';
  element('problem').textContent = text;
}

async function open(file) {
  complain('');
  try {
    if (/\.(json|html)$/i.test(file.name)) return reports.open(file.name, await file.text());
    const read = readRecording(file.name, new Uint8Array(await file.arrayBuffer()));
    recording = read;
    element('connection').textContent = `recording ${file.name}`;
    element('live').hidden = false;
    table.clear();
    redraw();
    choose([...read.keys()].sort()[0]);
  } catch (error) {
    complain(error.message);
  }
}

function goLive() {
  recording = null;
  element('live').hidden = true;
  element('connection').textContent = connectionText;
  table.clear();
  redraw();
  choose(table.names()[0] ?? null);
}

const reports = new Reports(element('reports-section'), element('reports'));
const table = new JointTable(element('joints'), choose);
const plots = new Plots(element('plots'), (from_s, to_s) => {
  if (!recording && pausedAt_s === null) setPaused(true);
  zoom = [from_s, to_s];
  redraw();
}, () => {
  zoom = null;
  redraw();
});

let connectionText = 'connecting';
function onMessage(topic, text, received_s) {
  if (topic.endsWith('.STATE')) return onState(topic, text, received_s);
  const joint = live.get(jointOf(topic, 'LIMITS'));
  if (joint) joint.limits = JSON.parse(text);
}
function onState(topic, text, received_s) {
  const state = JSON.parse(text);
  const name = jointOf(topic);
  if (!live.has(name)) live.set(name, {history: new History(), channel: topic.replace(/\.STATE$/, '')});
  const joint = live.get(name);
  const first = joint.last === undefined;
  joint.last = state;
  joint.received_s = now_s();
  joint.history.add(received_s, valuesOf(state));
  if (first && chosen === null && !recording) {
    redraw();
    choose(name);
  }
}

element('pause').addEventListener('click', () => setPaused(pausedAt_s === null));
element('span').addEventListener('change', () => {
  zoom = null;
  redraw();
});
element('live').addEventListener('click', goLive);
element('file').addEventListener('change', ({target}) => {
  if (target.files.length > 0) open(target.files[0]);
  target.value = '';
});
document.addEventListener('dragover', (event) => event.preventDefault());
document.addEventListener('drop', (event) => {
  event.preventDefault();
  if (event.dataTransfer.files.length > 0) open(event.dataTransfer.files[0]);
});
document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT)$/.test(event.target.tagName)) return;
  const spans = {1: '10', 2: '60', 3: '600'};
  if (event.key === 'ArrowDown') table.move(1);
  else if (event.key === 'ArrowUp') table.move(-1);
  else if (event.key === 'p') setPaused(pausedAt_s === null);
  else if (event.key in spans) {
    element('span').value = spans[event.key];
    zoom = null;
    redraw();
  } else return;
  event.preventDefault();
});

vocabulary = await (await fetch('vocabulary.json')).json();
const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
const connection = new Connection(`${scheme}://${location.host}/${location.search}`, onMessage, (text) => {
  connectionText = text;
  if (!recording) element('connection').textContent = text;
}, onControl);

/** A server without orders does not send metadata.acting, and has no acting.js. */
async function onControl(message) {
  if (message.op === 'serverInfo' && message.metadata?.acting) {
    if (actingAsked) return acting?.open();
    actingAsked = true;
    const {Acting} = await import('./acting.js').catch((error) => {
      actingAsked = false;
      complain(`the stop button of this page is missing, load the page again: ${error.message}`);
      throw error;
    });
    element('only-shows').hidden = true;
    acting = new Acting(connection, {joints: () => live, chosen: () => (recording ? null : chosen)});
  } else {
    acting?.take(message);
  }
}
setInterval(() => {
  forgetSilent();
  if (recording || document.hidden) return;
  if (pausedAt_s === null) redraw();
  else showJoints();
}, REDRAW_MS);
