// SPDX-License-Identifier: BSD-3-Clause
// Reads an MCAP file with the format's reference reader and prints its contents as one line of JSON.
//
//   node read.mjs FILE [--stream]     --stream: from the beginning up to the last whole chunk (a truncated file)
import { readFile } from 'node:fs/promises';
import { McapStreamReader } from '@mcap/core';
import { decompressHandlers, openIndexed } from './mcap_file.mjs';

const [file, mode] = process.argv.slice(2);
const found = { topics: {}, schemas: {}, keys: {}, wrong: 0, last: {} };
const channels = new Map();
const schemas = new Map();

function fits(value, type) {
  if (value === null) return type === 'number';
  if (type === 'integer') return Number.isInteger(value);
  if (type === 'array') return Array.isArray(value) && value.every((entry) => typeof entry === 'number');
  return typeof value === type;
}

function take(message) {
  const channel = channels.get(message.channelId);
  const schema = JSON.parse(new TextDecoder().decode(schemas.get(channel.schemaId).data));
  const value = JSON.parse(new TextDecoder().decode(message.data));
  for (const key of Object.keys(value))
    if (!(key in schema.properties) || !fits(value[key], schema.properties[key].type)) found.wrong += 1;
  for (const key of Object.keys(schema.properties)) if (!(key in value)) found.wrong += 1;
  found.topics[channel.topic] = (found.topics[channel.topic] ?? 0) + 1;
  found.schemas[channel.topic] = schema.title;
  found.last[channel.topic] = { log: String(message.logTime), published: String(message.publishTime), value };
}

if (mode === '--stream') {
  const reader = new McapStreamReader({ decompressHandlers });
  reader.append(await readFile(file));
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === 'Schema') schemas.set(record.id, record);
    if (record.type === 'Channel') channels.set(record.id, record);
    if (record.type === 'Message') take(record);
  }
} else {
  const reader = await openIndexed(file);
  for (const [id, schema] of reader.schemasById) schemas.set(id, schema);
  for (const [id, channel] of reader.channelsById) channels.set(id, channel);
  found.statistics = Number(reader.statistics.messageCount);
  found.chunks = reader.chunkIndexes.length;
  for await (const message of reader.readMessages()) take(message);
}
console.log(JSON.stringify(found));
