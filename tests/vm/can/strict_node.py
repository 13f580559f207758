# SPDX-License-Identifier: BSD-3-Clause
"""An independent CiA 402 servo drive: a CANopen node written from the standards' text (CiA 301, CiA 402-2), stricter than most.
PDO parameters may change only while the PDO is not valid, and mappings only while their count is 0. The drive turns one inertia with
friction, which takes a new torque with each SYNC in real time.

    strict_node.py INTERFACE NODE-ID [--vendor N] [--boot-after S] [--sdo-delay S] [--tpdo-delay S] [--late S] [--torque-lag N]
                   [--log FILE] [--track FILE]

Logs NMT commands, SDO reads and writes, and states, each with its utime. TRACK gets utime and position of each SYNC.
A torque acts --torque-lag SYNCs after the SYNC that follows it. SIGUSR1: restarts. SIGUSR2: delays TPDO1 by --late.
"""
import argparse
import heapq
import math
import select
import signal
import socket
import struct
import time

FRAME = struct.Struct('<IB3x8s')
ABORT_UNKNOWN = 0x06020000
ABORT_NOT_NOW = 0x08000022
ABORT_READ_ONLY = 0x06010002
ABORT_LENGTH = 0x06070010
VALID = 1 << 31
SO_TIMESTAMPNS = 35  # asm-generic/socket.h
COUNTS_rad = 320000 / (2 * math.pi)
RATED_Nm = 0.192 * 50  # 6076h, at the joint


class Joint:
    """An inertia that sticks until the torque exceeds its static friction. Then the Stribeck curve and viscous friction act."""
    INERTIA_kgm2, STATIC_Nm, COULOMB_Nm, VISCOUS_Nms_rad, STRIBECK_rad_s = 0.089, 1.6, 0.8, 0.3, 0.042
    STEP_s = 2e-4

    def __init__(self):
        self.position_rad = 0.0
        self.velocity_rad_s = 0.0

    def advance(self, torque_Nm, duration_s):
        steps = max(1, round(duration_s / self.STEP_s))
        step_s = duration_s / steps
        for _ in range(steps):
            velocity_rad_s = self.velocity_rad_s
            if velocity_rad_s == 0 and abs(torque_Nm) <= self.STATIC_Nm:
                return
            curve_Nm = self.COULOMB_Nm + (self.STATIC_Nm - self.COULOMB_Nm) * math.exp(-(velocity_rad_s / self.STRIBECK_rad_s) ** 2)
            friction_Nm = math.copysign(curve_Nm, velocity_rad_s or torque_Nm) + self.VISCOUS_Nms_rad * velocity_rad_s
            after_rad_s = velocity_rad_s + (torque_Nm - friction_Nm) / self.INERTIA_kgm2 * step_s
            if velocity_rad_s * after_rad_s < 0:
                after_rad_s = 0.0  # the joint stops before it reverses
            self.velocity_rad_s = after_rad_s
            self.position_rad += after_rad_s * step_s


def objects(node_id, vendor):
    """(index, sub) -> [value, bytes, writable]"""
    known = {(0x1000, 0): [0x00020192, 4, False], (0x1001, 0): [0, 1, False], (0x1003, 0): [0, 1, True],
             (0x1005, 0): [0x80, 4, True], (0x1006, 0): [1000, 4, True], (0x1014, 0): [0x80 + node_id, 4, True],
             (0x1016, 0): [1, 1, False], (0x1016, 1): [0, 4, True], (0x1017, 0): [0, 2, True],
             (0x1018, 0): [4, 1, False], (0x1018, 1): [vendor, 4, False], (0x1018, 2): [0x61500000, 4, False],
             (0x1018, 3): [1, 4, False], (0x1018, 4): [9, 4, False],
             (0x6040, 0): [0, 2, True], (0x6041, 0): [0x0250, 2, False], (0x6060, 0): [0, 1, True],
             (0x6061, 0): [0, 1, False], (0x6064, 0): [0, 4, False], (0x606C, 0): [0, 4, False],
             (0x6071, 0): [0, 2, True], (0x6077, 0): [0, 2, False], (0x6007, 0): [1, 2, True],
             (0x603F, 0): [0, 2, False], (0x605A, 0): [2, 2, True], (0x605E, 0): [2, 2, True],
             (0x6072, 0): [1000, 2, True], (0x6075, 0): [1000, 4, False], (0x6076, 0): [192, 4, False],
             (0x6502, 0): [1 << 9, 4, False], (0x60C2, 0): [2, 1, False], (0x60C2, 1): [1, 1, True],
             (0x60C2, 2): [0xFD, 1, True], (0x3201, 1): [253, 2, False]}
    for number in range(4):
        for base, cob_id in ((0x1400, 0x200), (0x1800, 0x180)):
            known[base + number, 0] = [5, 1, False]
            known[base + number, 1] = [VALID | (cob_id + 0x100 * number + node_id), 4, True]
            known[base + number, 2] = [255, 1, True]
            known[base + number, 3] = [0, 2, True]
            known[base + number, 5] = [0, 2, True]
            known[base + 0x200 + number, 0] = [0, 1, True]
            for place in range(1, 9):
                known[base + 0x200 + number, place] = [0, 4, True]
    return known


class Node:
    def __init__(self, options):
        self.options = options
        self.id = options.node_id
        self.log_file = open(options.log, 'w', buffering=1)
        self.socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.socket.bind((options.interface,))
        self.joint = Joint()
        self.torques_Nm = [0.0] * (options.torque_lag + 1)  # the first one acts next
        self.synced_ns = 0
        self.tpdo_delay_s = options.tpdo_delay
        self.track_file = open(options.track, 'w', buffering=1) if options.track else None
        self.waiting = []  # (instant, number, message)
        self.count = 0
        signal.signal(signal.SIGUSR1, lambda *_: self.restart())
        signal.signal(signal.SIGUSR2, lambda *_: self.become_late())
        self.restart()

    def log(self, text):
        self.log_file.write(f'{time.time_ns() // 1000} {text}\n')

    def later(self, delay_s, what):
        self.count += 1
        heapq.heappush(self.waiting, (time.monotonic() + delay_s, self.count, what))

    def restart(self):
        self.known = objects(self.id, self.options.vendor)
        self.state = 0
        self.syncs = 0
        self.order = None
        self.waiting.clear()
        self.log('off')
        self.later(self.options.boot_after, self.boot)

    def become_late(self):
        self.log('late')
        self.tpdo_delay_s = self.options.late

    def boot(self):
        self.state = 127
        self.log('boot')
        self.send(0x700 + self.id, b'\0')
        self.later(0.01, self.heartbeat)

    def heartbeat(self):
        period_ms = self.known[0x1017, 0][0]
        if period_ms:
            self.send(0x700 + self.id, bytes([self.state]))
        self.later(period_ms / 1000 if period_ms else 0.01, self.heartbeat)

    def send(self, can_id, data):
        self.socket.send(FRAME.pack(can_id, len(data), data.ljust(8, b'\0')))

    def run(self):
        while True:
            wait_s = max(0, self.waiting[0][0] - time.monotonic()) if self.waiting else 1
            if select.select([self.socket], [], [], wait_s)[0]:
                frame, ancillary, _, _ = self.socket.recvmsg(16, socket.CMSG_SPACE(16))
                can_id, length, data = FRAME.unpack(frame)
                seconds, nanoseconds = struct.unpack('<qq', ancillary[0][2])
                self.take(can_id, data[:length], seconds * 10**9 + nanoseconds)
            while self.waiting and self.waiting[0][0] <= time.monotonic():
                heapq.heappop(self.waiting)[2]()

    def take(self, can_id, data, time_ns):
        if can_id == 0x80:
            self.move(time_ns)
        if self.state == 0:
            return  # the node has not booted and hears nothing
        if can_id == 0 and len(data) == 2 and data[1] in (0, self.id):
            self.obey_network(data[0])
        elif can_id == 0x80 and self.state == 5:
            self.sync()
        elif can_id == 0x600 + self.id and self.state != 4 and len(data) == 8:
            answer = self.serve(data)
            self.later(self.options.sdo_delay, lambda: self.send(0x580 + self.id, answer))
        elif self.state == 5:
            for number in range(4):
                if can_id == self.known[0x1400 + number, 1][0]:
                    self.unpack(0x1600 + number, data)

    def obey_network(self, command):
        self.log(f'nmt {command}')
        if command in (129, 130):
            self.restart()
        elif command in (1, 2, 128):
            self.state = {1: 5, 2: 4, 128: 127}[command]
            if self.state != 5:
                self.set_controlword(0)

    # SDO, expedited only: no object of the dictionary is longer.
    def serve(self, data):
        command, index, sub = struct.unpack_from('<BHB', data)
        abort = None
        if command == 0x40:
            self.log(f'read {index:04X}:{sub}')
            if (index, sub) in self.known:
                value, size, _ = self.known[index, sub]
                return struct.pack('<BHBI', 0x43 | (4 - size) << 2, index, sub, value)
            abort = ABORT_UNKNOWN
        elif command & 0xE3 == 0x23:
            size = 4 - (command >> 2 & 3)
            value = int.from_bytes(data[4:4 + size], 'little')
            abort = self.write(index, sub, value, size)
            self.log(f'write {index:04X}:{sub} {value:X}' + (f' refused {abort:08X}' if abort else ''))
            if abort is None:
                return struct.pack('<BHBI', 0x60, index, sub, 0)
        return struct.pack('<BHBI', 0x80, index, sub, abort or 0x05040001)

    def write(self, index, sub, value, size):
        entry = self.known.get((index, sub))
        if entry is None:
            return ABORT_UNKNOWN
        if not entry[2]:
            return ABORT_READ_ONLY
        if size != entry[1]:
            return ABORT_LENGTH
        if index & 0xF200 in (0x1400, 0x1800) and 0x1400 <= index < 0x1A00 and index & 0x0200 == 0:
            valid = not self.known[index, 1][0] & VALID
            if valid and not (sub == 1 and value & VALID):
                return ABORT_NOT_NOW
        if 0x1600 <= index < 0x1604 or 0x1A00 <= index < 0x1A04:
            if not self.known[index - 0x200, 1][0] & VALID:
                return ABORT_NOT_NOW
            if sub and self.known[index, 0][0]:
                return ABORT_NOT_NOW
            if sub and (value >> 16, value >> 8 & 0xFF) not in self.known:
                return ABORT_UNKNOWN
        entry[0] = value
        if index == 0x6040:
            self.set_controlword(value)
        if index == 0x6060:
            self.known[0x6061, 0][0] = value
        return None

    # Process data.
    def mapped(self, index):
        for place in range(1, self.known[index, 0][0] + 1):
            mapping = self.known[index, place][0]
            yield (mapping >> 16, mapping >> 8 & 0xFF), (mapping & 0xFF) // 8

    def unpack(self, index, data):
        for key, size in self.mapped(index):
            value, data = int.from_bytes(data[:size], 'little'), data[size:]
            self.known[key][0] = value
            if key == (0x6040, 0):
                self.set_controlword(value)

    def move(self, time_ns):
        """Advances the joint to this SYNC and takes the torque for the time after it."""
        if self.synced_ns:
            self.joint.advance(self.torques_Nm[0], (time_ns - self.synced_ns) / 1e9)
        self.synced_ns = time_ns
        counts = round(self.joint.position_rad * COUNTS_rad)
        self.known[0x6064, 0][0] = counts & 0xFFFFFFFF
        order = self.known[0x6071, 0][0]
        enabled = self.state == 5 and self.known[0x6041, 0][0] & 0x6F == 0x27
        order_Nm = ((order ^ 0x8000) - 0x8000) / 1000 * RATED_Nm if enabled else 0.0
        self.torques_Nm = self.torques_Nm[1:] + [order_Nm]
        if self.track_file:
            self.track_file.write(f'{time_ns // 1000} {self.joint.position_rad:.6f}\n')

    def sync(self):
        self.syncs += 1
        for number in range(4):
            cob_id, kind = self.known[0x1800 + number, 1][0], self.known[0x1800 + number, 2][0]
            if cob_id & VALID or not 1 <= kind <= 240 or self.syncs % kind:
                continue
            data = b''.join((self.known[key][0] & (1 << 8 * size) - 1).to_bytes(size, 'little')
                            for key, size in self.mapped(0x1A00 + number))
            if number == 0 and self.tpdo_delay_s > 0:
                self.later(self.tpdo_delay_s, lambda id=cob_id, sent=data: self.send(id & 0x7FF, sent))
            else:
                self.send(cob_id & 0x7FF, data)

    # CiA 402-2, figure of the power drive system.
    def set_controlword(self, order):
        status = self.known[0x6041, 0]
        disabled, ready, on, enabled = 0x40, 0x21, 0x23, 0x27
        state = status[0] & 0x6F
        if not order & 2 or not order & 4:
            state = disabled
        elif order & 7 == 6:
            state = ready
        elif order & 15 == 7 and state != disabled:
            state = on
        elif order & 15 == 15 and state in (ready, on, enabled):
            state = enabled
        status[0] = status[0] & ~0x106F | state | (0x1000 if state == enabled else 0)
        if order != self.order:
            self.log(f'controlword {order:X}')
        self.order = order


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('interface')
    parser.add_argument('node_id', type=int)
    parser.add_argument('--vendor', type=lambda text: int(text, 0), default=0xFB)
    parser.add_argument('--boot-after', type=float, default=0.0)
    parser.add_argument('--sdo-delay', type=float, default=0.0)
    parser.add_argument('--tpdo-delay', type=float, default=0.0)
    parser.add_argument('--late', type=float, default=0.0)
    parser.add_argument('--torque-lag', type=int, default=0)
    parser.add_argument('--log', default='strict.log')
    parser.add_argument('--track')
    Node(parser.parse_args()).run()


if __name__ == '__main__':
    main()
