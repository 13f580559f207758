// SPDX-License-Identifier: BSD-3-Clause
// The page's memory of 64 joints at 50 Hz, in virtual time. After ten minutes it does not grow, and it holds the last ten minutes.
//
//   node history.mjs HISTORY.JS
import fs from 'node:fs';

const JOINTS = 64;
const RATE_HZ = 50;
const {FIELDS, History, KEPT_S} = await import(`data:text/javascript;base64,${fs.readFileSync(process.argv[2]).toString('base64')}`);

function expect(holds, what) {
  if (holds) return;
  console.error(`wrong: ${what}`);
  process.exit(1);
}

const histories = Array.from({length: JOINTS}, () => new History());
const values = FIELDS.map(() => 0);
let sample = 0;
function run(seconds) {
  for (const end = sample + seconds * RATE_HZ; sample < end; ++sample) {
    values[FIELDS.indexOf('joint_position_rad')] = sample;
    for (const history of histories) history.add(sample / RATE_HZ, values);
  }
  return process.memoryUsage().arrayBuffers / 1e6;
}

const first_MB = run(10);
const full_MB = run(KEPT_S + 10);
const later_MB = run(KEPT_S);
console.log(`${JOINTS} joints: ${first_MB.toFixed(1)} MB after 10 s, ${full_MB.toFixed(1)} after ${KEPT_S + 20} s, ${later_MB.toFixed(1)} after ${2 * KEPT_S + 20} s`);
expect(first_MB < 0.1 * full_MB, 'a joint that was just heard costs as much as one of ten minutes');
expect(later_MB <= full_MB, `memory grows: ${full_MB} MB, then ${later_MB} MB`);
const [times, positions] = histories[0].window(['joint_position_rad'], -Infinity, Infinity, Infinity);
expect(times.length === KEPT_S * RATE_HZ, `${times.length} samples are kept`);
expect(positions.at(-1) === sample - 1 && positions.every((position, i) => i === 0 || position === positions[i - 1] + 1), 'the last ten minutes, in order');
