// SPDX-License-Identifier: BSD-3-Clause
// Watches a telemetry server with the reference client of the protocol and prints the received data as one line of JSON.
//
//   node watch.mjs URL SECONDS [--slow]     --slow: reads nothing for half of the time
import protocol from '@foxglove/ws-protocol';
import { WebSocket } from 'ws';

const { FoxgloveClient } = protocol;
const [url, seconds, mode] = process.argv.slice(2);
const socket = new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
const client = new FoxgloveClient({ ws: socket });
const found = { server: null, topics: {}, wrong: [], last: {}, status: [], errors: [] };
const channels = new Map();
const subscriptions = new Map();

function fits(value, type) {
  if (value === null) return type === 'number';
  if (type === 'integer') return Number.isInteger(value);
  if (type === 'array') return Array.isArray(value) && value.every((entry) => typeof entry === 'number');
  return typeof value === type;
}

client.on('serverInfo', (info) => (found.server = info));
client.on('status', (status) => found.status.push(status));
client.on('error', (error) => found.errors.push(String(error)));
client.on('advertise', (added) => {
  for (const channel of added) {
    if (channel.encoding !== 'json' || channel.schemaEncoding !== 'jsonschema') found.wrong.push(channel.topic);
    channels.set(channel.id, { topic: channel.topic, schema: JSON.parse(channel.schema) });
    subscriptions.set(client.subscribe(channel.id), channel.id);
    found.topics[channel.topic] = 0;
  }
});
client.on('message', ({ subscriptionId, timestamp, data }) => {
  const { topic, schema } = channels.get(subscriptions.get(subscriptionId));
  const value = JSON.parse(new TextDecoder().decode(data));
  for (const key of Object.keys(value))
    if (!(key in schema.properties) || !fits(value[key], schema.properties[key].type)) found.wrong.push(`${topic} ${key}`);
  for (const key of Object.keys(schema.properties)) if (!(key in value)) found.wrong.push(`${topic} lacks ${key}`);
  if (found.last[topic] && BigInt(found.last[topic].received) > timestamp) found.wrong.push(`${topic} out of order`);
  found.topics[topic] += 1;
  found.last[topic] = { received: String(timestamp), value };
});

if (mode === '--slow')
  setTimeout(() => {
    socket.pause();
    setTimeout(() => socket.resume(), seconds * 500);
  }, seconds * 250);
setTimeout(() => {
  found.protocol = socket.protocol;
  console.log(JSON.stringify(found));
  process.exit(0);
}, seconds * 1000);
