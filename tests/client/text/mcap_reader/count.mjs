// SPDX-License-Identifier: BSD-3-Clause
// Counts the states of a long MCAP recording with the format's reference reader, chunk by chunk. Prints the numbers of joints and states, and the
// missing cycles between the first and the last state of each joint. Then how often states came out of order, and the daemon's counts from its first
// to its last TIMING. One line of JSON.
//
//   node count.mjs FILE
import { openIndexed } from './mcap_file.mjs';

const reader = await openIndexed(process.argv[2]);
const topics = new Map([...reader.channelsById].map(([id, channel]) => [id, channel.topic]));
const joints = new Map();
const timings = [];
const text = new TextDecoder();
for await (const message of reader.readMessages()) {
  const topic = topics.get(message.channelId);
  if (topic.endsWith('.TIMING')) timings.push(JSON.parse(text.decode(message.data)));
  if (!topic.endsWith('.STATE')) continue;
  const { cycle } = JSON.parse(text.decode(message.data));
  const joint = joints.get(topic);
  if (!joint) {
    joints.set(topic, { first: cycle, last: cycle, states: 1, steps: new Map(), backwards: 0 });
    continue;
  }
  const step = cycle - joint.last;
  if (step <= 0) joint.backwards += 1;
  joint.steps.set(step, (joint.steps.get(step) ?? 0) + 1);
  joint.last = cycle;
  joint.states += 1;
}
// A daemon publishes every n-th cycle. The most frequent step is n, and longer steps mean missing states.
let states = 0, missing = 0, backwards = 0;
for (const joint of joints.values()) {
  const usual = [...joint.steps].reduce((most, entry) => (entry[1] > most[1] ? entry : most), [1, 0])[0];
  states += joint.states;
  missing += Math.round((joint.last - joint.first) / usual) + 1 - joint.states;
  backwards += joint.backwards;
}
const counted = (name) => (timings.length > 0 ? timings.at(-1)[name] - timings[0][name] : null);
console.log(JSON.stringify({ joints: joints.size, states, missing, backwards, messages: Number(reader.statistics.messageCount),
  timings: timings.length, cycles: counted('cycles'), overruns: counted('overruns'), not_published: counted('state_records_dropped') }));
