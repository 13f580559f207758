// SPDX-License-Identifier: BSD-3-Clause
// Reads recordings as histories by joint: CSV of `strainwavectl export` and of flight records, and MCAP of `strainwavectl export --mcap`.
import {jointOf} from './connection.js';
import {decompress} from './fzstd.mjs';
import {History, valuesOf} from './history.js';

const MAGIC = '\x89MCAP0\r\n';
const OP = {schema: 3, channel: 4, message: 5, chunk: 6};

/** Map of joint to {history, last, fault_s, from_s, to_s}. Throws Error with a text for the user. */
export function readRecording(name, bytes) {
  const magic = String.fromCharCode(...bytes.subarray(0, 8));
  const samples = magic === MAGIC ? readMcap(bytes) : readCsv(new TextDecoder().decode(bytes));
  if (samples.size === 0) throw new Error(`${name}: the file has no states; a CSV of strainwavectl export, a flight record, or an MCAP file of one of them is expected`);
  return new Map([...samples].map(([joint, rows]) => [joint, asRecording(rows)]));
}

function asRecording(rows) {
  const history = new History(rows.length, 0);
  let fault_s = null;
  for (const {time_s, state} of rows) {
    history.add(time_s, valuesOf(state));
    if (fault_s === null && state.fault > 0) fault_s = time_s;
  }
  return {history, last: rows.at(-1).state, fault_s, from_s: rows[0].time_s, to_s: rows.at(-1).time_s};
}

function push(samples, joint, time_s, state) {
  if (!samples.has(joint)) samples.set(joint, []);
  samples.get(joint).push({time_s, state});
}

export function readCsv(text) {
  const lines = text.split('\n').filter((line) => line !== '' && !line.startsWith('#'));
  const jointOfFile = /^# joint: (.*)$/m.exec(text)?.[1].trim() ?? 'recording';
  const columns = (lines.shift() ?? '').split(',');
  if (!columns.includes('time_s') || !columns.includes('joint_position_rad')) throw new Error('the CSV file has no columns time_s and joint_position_rad: export it with strainwavectl export');
  const samples = new Map();
  for (const line of lines) {
    const fields = line.split(',');
    const state = {};
    columns.forEach((column, i) => {
      const value = Number(fields[i]);
      state[column] = fields[i] === '' || fields[i] === undefined ? null : Number.isNaN(value) ? fields[i] : value;
    });
    if (typeof state.time_s === 'number') push(samples, String(state.joint ?? jointOfFile), state.time_s, state);
  }
  return samples;
}

function* recordsOf(bytes, from = 0) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let at = from; at + 9 <= bytes.length;) {
    const length = Number(view.getBigUint64(at + 1, true));
    if (at + 9 + length > bytes.length) return; // the writer was interrupted here
    yield {op: bytes[at], body: bytes.subarray(at + 9, at + 9 + length)};
    at += 9 + length;
  }
}

function chunkContent(body) {
  const view = new DataView(body.buffer, body.byteOffset, body.byteLength);
  const nameBytes = view.getUint32(28, true);
  const compression = new TextDecoder().decode(body.subarray(32, 32 + nameBytes));
  const content = body.subarray(32 + nameBytes + 8);
  if (compression === '') return content;
  if (compression !== 'zstd') throw new Error(`the MCAP file is compressed by ${compression}; zstd is expected`);
  return decompress(content);
}

export function readMcap(bytes) {
  const decoder = new TextDecoder();
  const topics = new Map();
  const samples = new Map();
  const take = ({op, body}) => {
    const view = new DataView(body.buffer, body.byteOffset, body.byteLength);
    if (op === OP.channel) {
      const length = view.getUint32(4, true);
      topics.set(view.getUint16(0, true), decoder.decode(body.subarray(8, 8 + length)));
    } else if (op === OP.message) {
      const joint = jointOf(topics.get(view.getUint16(0, true)) ?? '', 'STATE|FLIGHT');
      if (joint !== undefined) push(samples, joint, Number(view.getBigUint64(6, true)) / 1e9, JSON.parse(decoder.decode(body.subarray(22))));
    } else if (op === OP.chunk) {
      for (const record of recordsOf(chunkContent(body))) take(record);
    }
  };
  for (const record of recordsOf(bytes, MAGIC.length)) take(record);
  return samples;
}
