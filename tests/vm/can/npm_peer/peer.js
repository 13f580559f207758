// SPDX-License-Identifier: BSD-3-Clause
// A CANopen node made of third-party packages (npm: canopen, socketcan). They provide SDO server, PDO, NMT, heartbeat and EMCY, against which our
// client is tested. This file only makes a servo drive of it: the objects of CiA 402, and the statusword that answers the controlword. There is no
// joint behind it: its position does not change.
//
//   node peer.js INTERFACE NODE-ID [position]     position: the drive closes its own loop and has no torque mode
//
// Records NMT states, controlwords and ordered positions. Lines on standard input: "emcy CODE"; "late MS": SDO answers are delayed by MS; "wrong":
// SDO answers name another object than the request; "right": neither.
'use strict';
const readline = require('readline');
const can = require('socketcan');
const { AccessType, DataType, Device, Eds, NmtState, ObjectType } = require('canopen');

const [interfaceName, idText, modeText] = process.argv.slice(2);
const id = Number(idText);
const byPosition = modeText === 'position';
const { INTEGER8, INTEGER16, INTEGER32, UNSIGNED8, UNSIGNED16, UNSIGNED32 } = DataType;

// A reset restores the default of an entry.
function keep(entry, value) {
  entry.value = value;
  entry.defaultValue = value;
}

function addVariable(eds, index, dataType, value, accessType = AccessType.READ_WRITE) {
  const entry = eds.addEntry(index, {
    parameterName: `object ${index.toString(16)}`, objectType: ObjectType.VAR, dataType, accessType, pdoMapping: true,
  });
  keep(entry, value);
  return entry;
}

function makeObjects() {
  const eds = new Eds();
  const kept = { saveDefault: true };
  keep(eds.getEntry(0x1000), 0x00020192);
  eds.setErrorRegister(0);
  eds.setErrorHistoryLength(4, kept);
  eds.setSyncCobId(0x80, kept);
  eds.setSyncCyclePeriod(1000, kept);
  eds.setDeviceName('A peer written by others', kept);
  eds.setEmcyCobId(0x80 + id, kept);
  eds.addHeartbeatConsumer(127, 1000, kept);
  // The library would make it 32 bits wide, but the standard says 16.
  addVariable(eds, 0x1017, UNSIGNED16, 0);
  eds.setIdentity({ vendorId: 0xFB, productCode: 0x61500000, revisionNumber: 1, serialNumber: 7 }, kept);
  eds.addSdoServerParameter(0, 0x580 + id, 0x600 + id, kept);

  const controlword = addVariable(eds, 0x6040, UNSIGNED16, 0);
  const statusword = addVariable(eds, 0x6041, UNSIGNED16, 0x0250, AccessType.READ_ONLY);
  const mode = addVariable(eds, 0x6060, INTEGER8, 0);
  const modeDisplay = addVariable(eds, 0x6061, INTEGER8, 0, AccessType.READ_ONLY);
  const position = addVariable(eds, 0x6064, INTEGER32, 160000, AccessType.READ_ONLY);
  addVariable(eds, 0x606C, INTEGER32, 0, AccessType.READ_ONLY);
  const torque = byPosition ? null : addVariable(eds, 0x6071, INTEGER16, 0);
  const place = addVariable(eds, 0x607A, INTEGER32, 0);
  const torqueOffset = addVariable(eds, 0x60B2, INTEGER16, 0);
  const torqueActual = addVariable(eds, 0x6077, INTEGER16, 0, AccessType.READ_ONLY);
  addVariable(eds, 0x6007, INTEGER16, 1);
  addVariable(eds, 0x603F, UNSIGNED16, 0, AccessType.READ_ONLY);
  addVariable(eds, 0x605A, INTEGER16, 2);
  addVariable(eds, 0x605E, INTEGER16, 2);
  addVariable(eds, 0x6072, UNSIGNED16, 1000);
  addVariable(eds, 0x6075, UNSIGNED32, 1000, AccessType.READ_ONLY);
  addVariable(eds, 0x6076, UNSIGNED32, 192, AccessType.READ_ONLY);
  addVariable(eds, 0x6065, UNSIGNED32, 2000);
  addVariable(eds, 0x6502, UNSIGNED32, byPosition ? 1 << 7 : 1 << 9, AccessType.READ_ONLY);
  const interpolation = eds.addEntry(0x60C2, { parameterName: 'interpolation period', objectType: ObjectType.RECORD });
  interpolation.addSubObject(1, { parameterName: 'period', dataType: UNSIGNED8, accessType: AccessType.READ_WRITE });
  interpolation.addSubObject(2, { parameterName: 'exponent', dataType: INTEGER8, accessType: AccessType.READ_WRITE });
  keep(interpolation.at(1), 1);
  keep(interpolation.at(2), -3);
  const temperature = eds.addEntry(0x3201, { parameterName: 'temperature', objectType: ObjectType.RECORD });
  temperature.addSubObject(1, { parameterName: 'motor', dataType: INTEGER16, accessType: AccessType.READ_ONLY });
  keep(temperature.at(1), 253);

  // The library maps PDOs when it starts. These are the PDOs that our driver asks for.
  const orders = byPosition ? [controlword, place, torqueOffset] : [controlword, torque];
  eds.addReceivePdo({ cobId: 0x200 + id, transmissionType: 1, dataObjects: orders }, kept);
  eds.addTransmitPdo({ cobId: 0x180 + id, transmissionType: 1, dataObjects: [position, statusword, torqueActual] }, kept);
  eds.addTransmitPdo({ cobId: 0x280 + id, transmissionType: 10, dataObjects: [temperature.at(1), modeDisplay] }, kept);
  return { eds, controlword, statusword, mode, modeDisplay, place };
}

// CiA 402: returns the statusword after a controlword. The drive obeys without faults and delays.
function statusAfter(status, order) {
  const state = status & 0x6F;
  const switchOnDisabled = 0x40, ready = 0x21, switchedOn = 0x23, enabled = 0x27;
  let next = state;
  if ((order & 0x02) === 0 || (order & 0x04) === 0) next = switchOnDisabled;
  else if ((order & 0x07) === 0x06) next = ready;
  else if (state !== switchOnDisabled && (order & 0x0F) === 0x07) next = switchedOn;
  else if ((state === switchedOn || state === ready) && (order & 0x0F) === 0x0F) next = enabled;
  const followsOrder = next === enabled ? 0x1000 : 0;  // CST: the drive follows its orders
  return (status & ~0x106F) | next | followsOrder;
}

function main() {
  const objects = makeObjects();
  const device = new Device({ id, eds: objects.eds });
  const channel = can.createRawChannel(interfaceName);
  let late_ms = 0;
  let wrong = false;
  device.addListener('message', (message) => {
    if (message.id !== 0x580 + id) return channel.send(message);
    const data = Buffer.from(message.data);
    if (wrong) data[1] ^= 0x01;  // the low byte of the index
    const answer = {...message, data};
    if (late_ms > 0)
      setTimeout(() => channel.send(answer), late_ms);
    else
      channel.send(answer);
  });
  channel.addListener('onMessage', (message) => device.receive(message));
  let lastOrder = -1;
  let lastPlace = 0;
  // An RPDO changes the entries without an "update" event. It emits "pdo" instead.
  const obey = () => {
    const order = objects.controlword.value;
    objects.statusword.value = statusAfter(objects.statusword.value, order);
    if (order !== lastOrder) console.log(`controlword ${order.toString(16)} status ${objects.statusword.value.toString(16)}`);
    lastOrder = order;
    if (byPosition && objects.place.value !== lastPlace) console.log(`place ${objects.place.value}`);
    lastPlace = objects.place.value;
  };
  objects.controlword.addListener('update', obey);
  device.pdo.addListener('pdo', obey);
  objects.mode.addListener('update', () => { objects.modeDisplay.value = objects.mode.value; });
  let lastState = NmtState.INITIALIZING;
  device.nmt.addListener('changeState', (state) => {
    console.log(`nmt ${state}`);
    // The library sends no boot-up message.
    if (lastState === NmtState.INITIALIZING) channel.send({ id: 0x700 + id, data: Buffer.from([0]) });
    lastState = state;
  });
  device.nmt.addListener('timeout', (node) => console.log(`heartbeat-lost ${node}`));
  readline.createInterface({ input: process.stdin }).on('line', (line) => {
    const [verb, code] = line.split(' ');
    // Passes the code alone, because the library loses it when it is passed in an object.
    if (verb === 'emcy') device.emcy.write(Number(code));
    if (verb === 'late') late_ms = Number(code);
    if (verb === 'wrong') wrong = true;
    if (verb === 'right') [late_ms, wrong] = [0, false];
    console.log(`told ${line}`);
  });
  channel.start();
  device.start();
  console.log(`ready ${NmtState.PRE_OPERATIONAL}`);
}

main();
