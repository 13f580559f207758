// SPDX-License-Identifier: BSD-3-Clause
// Sends one order as the page of strainwave-telemetry does and prints the answer. Ends with 0 when it is accepted.
//
//   node page_order.mjs ADDRESS-WITH-TOKEN PREFIX.JOINT ACTION
import http from 'node:http';

const [, , address, joint, action] = process.argv;
const {hash, host, origin} = new URL(address);
const token = hash.replace('#token=', '');
const PATIENCE_MS = 15000;
setTimeout(() => {
  console.log('no answer');
  process.exit(1);
}, PATIENCE_MS);

function* framesOf(bytes) {
  let [at, begin, size] = [0, 0, 0];
  for (; at + 10 <= bytes.length; at = begin + size) {
    const length = bytes[at + 1];
    begin = at + (length === 127 ? 10 : length === 126 ? 4 : 2);
    size = length === 127 ? Number(bytes.readBigUInt64BE(at + 2)) : length === 126 ? bytes.readUInt16BE(at + 2) : length;
    if (begin + size > bytes.length) break;
    yield {isLast: bytes[at] >= 128, kind: bytes[at] & 15, body: bytes.subarray(begin, begin + size), end: begin + size};
  }
}

http.get({host: host.split(':')[0], port: host.split(':')[1], headers: {
  Connection: 'Upgrade', Upgrade: 'websocket', Origin: origin, 'Sec-WebSocket-Version': 13, 'Sec-WebSocket-Key': Buffer.alloc(16).toString('base64'),
  'Sec-WebSocket-Protocol': 'foxglove.websocket.v1',
}}).on('upgrade', (response, socket, head) => {
  let waiting = head;
  let parts = []; // payloads of a message in several frames
  let isOpen = false;
  const send = (message) => {
    const body = Buffer.from(JSON.stringify(message));
    const size = body.length < 126 ? [0x80 | body.length] : [0x80 | 126, body.length >> 8, body.length & 255];
    socket.write(Buffer.concat([Buffer.from([0x81, ...size, 0, 0, 0, 0]), body])); // a mask of zeros leaves the body unchanged
  };
  const take = (kind, body) => {
    if (kind === 2) {
      if (!isOpen) return;
      const {session_id, challenge} = JSON.parse(body.subarray(13));
      isOpen = false; // send the order only once
      return send({op: 'act', action, joint, session_id, challenge});
    }
    const message = JSON.parse(body);
    if (message.op === 'advertise') {
      const subscriptions = message.channels.filter(({topic}) => topic === `${joint}.STATE`).map(({id}) => ({id, channelId: id}));
      if (subscriptions.length > 0) send({op: 'subscribe', subscriptions});
    } else if (message.op === 'acting') {
      isOpen = message.open;
      if (action === 'stop') send({op: 'act', action});
    } else if (message.op === 'acted') {
      console.log(message.text);
      process.exit(message.refused ? 1 : 0);
    }
  };
  const read = (bytes) => {
    waiting = Buffer.concat([waiting, bytes]);
    let end = 0;
    for (const frame of framesOf(waiting)) {
      end = frame.end;
      parts.push(frame);
      if (!frame.isLast) continue;
      take(parts[0].kind, Buffer.concat(parts.map(({body}) => body)));
      parts = [];
    }
    waiting = waiting.subarray(end);
  };
  socket.on('data', read);
  send({op: 'act', action: 'open', token});
  read(Buffer.alloc(0));
});
