// SPDX-License-Identifier: BSD-3-Clause
// A viewer of strainwave-telemetry. It uses four messages of the Foxglove WebSocket protocol, and reconnects when the server is gone.

const RETRY_MS = 1000;
const HEAD_BYTES = 13; // opcode, subscription, time of receipt in nanoseconds

/** The joint of a topic PREFIX.JOINT.KIND; the default prefix SW is left out. Undefined if the topic is of another kind. */
export function jointOf(topic, kinds = 'STATE') {
  return new RegExp(`^(?:SW\\.)?(.*)\\.(?:${kinds})$`).exec(topic)?.[1];
}

export class Connection {
  /** `onMessage(topic, text, received_s)`: the JSON text of one message. `onChange(text)`: the state of the connection in words.
   *  `onControl(message)`: messages that are not about topics. */
  constructor(url, onMessage, onChange, onControl) {
    this.url = url;
    this.onMessage = onMessage;
    this.onChange = onChange;
    this.onControl = onControl;
    this.decoder = new TextDecoder();
    this.open();
  }

  open() {
    this.topics = new Map(); // by subscription, whose number is that of the topic
    const socket = new WebSocket(this.url, ['foxglove.sdk.v1', 'foxglove.websocket.v1']);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.onChange('live');
    socket.onmessage = ({data}) => (typeof data === 'string' ? this.control(socket, JSON.parse(data)) : this.message(data));
    socket.onclose = () => {
      this.onChange('lost contact with strainwave-telemetry; trying again');
      setTimeout(() => this.open(), RETRY_MS);
    };
  }

  control(socket, message) {
    if (message.op === 'advertise') {
      const wanted = message.channels.filter((channel) => /\.(STATE|LIMITS)$/.test(channel.topic) && channel.encoding === 'json');
      for (const channel of wanted) this.topics.set(channel.id, channel.topic);
      const subscriptions = wanted.map((channel) => ({id: channel.id, channelId: channel.id}));
      if (subscriptions.length > 0) socket.send(JSON.stringify({op: 'subscribe', subscriptions}));
    } else if (message.op === 'unadvertise') {
      for (const id of message.channelIds) this.topics.delete(id);
    } else if (message.op === 'status' && message.level > 0) {
      this.onChange(`live; ${message.message}`);
    } else {
      this.onControl(message);
    }
  }

  /** Returns false if there is no connection. */
  send(message) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  message(data) {
    const view = new DataView(data);
    const topic = this.topics.get(view.getUint32(1, true));
    if (topic === undefined || view.getUint8(0) !== 1) return;
    const received_s = Number(view.getBigUint64(5, true)) / 1e9;
    this.onMessage(topic, this.decoder.decode(new Uint8Array(data, HEAD_BYTES)), received_s);
  }
}
