#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A fake sysfs folder of a PWM chip that refuses what Linux 6.1 refuses, for machines whose kernel has no PWM. It is a file system on
/dev/fuse in plain Python.

  kernel_pwm.py FOLDER LOG [PERIOD_NS DUTY_NS ENABLE POLARITY]

It is mounted on FOLDER until SIGTERM. Channel 0 is not exported, as after a boot, or exported with the given settings. It logs
every write to LOG: the file, the text, "taken" or "refused", and the channel's state after it.

Sources: pwm_apply_state in drivers/pwm/core.c of Linux 6.1, whatever the change: no period, or a duty above it, is EINVAL; every file of
drivers/pwm/sysfs.c sets its one field of the state and applies all of it. Documentation/ABI/testing/sysfs-class-pwm: the polarity "can only be
changed if the PWM is not enabled". include/uapi/linux/fuse.h."""
import errno
import os
import signal
import struct
import subprocess
import sys

LOOKUP, FORGET, GETATTR, SETATTR, OPEN, READ, WRITE = 1, 2, 3, 4, 14, 15, 16
RELEASE, FLUSH, INIT, OPENDIR, READDIR, RELEASEDIR, INTERRUPT, BATCH_FORGET = 18, 25, 26, 27, 28, 29, 36, 42
DIRECT_IO = 1  # the kernel ignores a file's size
ROOT = 1
FILES = ['export', 'npwm', 'pwm0/period', 'pwm0/duty_cycle', 'pwm0/enable', 'pwm0/polarity']
NODES = {ROOT: '', 2: 'pwm0', **{3 + i: name for i, name in enumerate(FILES)}}
NUMBERS = {name: node for node, name in NODES.items()}


class Refused(Exception):
    """The answer to the kernel is an error number."""


class Channel:
    def __init__(self, left):
        self.exported = bool(left)
        self.state = {'period': 0, 'duty_cycle': 0, 'enable': 0, 'polarity': 'normal'}
        if left:
            self.state = {'period': int(left[0]), 'duty_cycle': int(left[1]), 'enable': int(left[2]), 'polarity': left[3]}

    def apply(self, field, value):
        wanted = {**self.state, field: value}
        if wanted['period'] == 0 or wanted['duty_cycle'] > wanted['period']:
            raise Refused(errno.EINVAL)
        if self.state['enable'] and wanted['polarity'] != self.state['polarity']:
            raise Refused(errno.EINVAL)
        self.state = wanted

    def write(self, name, text):
        if name == 'export':
            if text != '0':
                raise Refused(errno.ENODEV)
            if self.exported:
                raise Refused(errno.EBUSY)
            self.exported = True
            return
        field = name.removeprefix('pwm0/')
        if field == 'polarity' and text in ('normal', 'inversed'):
            return self.apply(field, text)
        if field in ('period', 'duty_cycle') and text.isdigit() or field == 'enable' and text in ('0', '1'):
            return self.apply(field, int(text))
        raise Refused(errno.EINVAL)

    def read(self, name):
        return '1' if name == 'npwm' else str(self.state[name.removeprefix('pwm0/')])

    def visible(self, name):
        return name in NUMBERS and (self.exported or not name.startswith('pwm0'))


def attributes(node):
    name = NODES[node]
    mode = 0o040755 if name in ('', 'pwm0') else 0o100200 if name == 'export' else 0o100644
    return struct.pack('<6Q10I', node, 4096, 0, 0, 0, 0, 0, 0, 0, mode, 1, 0, 0, 0, 4096, 0)


def answer(channel, log, operation, node, body):
    """Answers a request of the kernel to the file system."""
    if operation == INIT:
        major, minor = struct.unpack_from('<2I', body)
        return struct.pack('<4I2H2I2HI7I', major, min(minor, 31), 4096, 0, 12, 10, 4096, 1, 1, 0, 0, *[0] * 7)
    if operation == LOOKUP:
        name = (NODES[node] + '/' + body.rstrip(b'\0').decode()).lstrip('/')
        if not channel.visible(name):
            raise Refused(errno.ENOENT)
        return struct.pack('<4Q2I', NUMBERS[name], 0, 0, 0, 0, 0) + attributes(NUMBERS[name])
    if operation in (GETATTR, SETATTR):  # sysfs ignores truncation
        return struct.pack('<Q2I', 0, 0, 0) + attributes(node)
    if operation in (OPEN, OPENDIR):
        return struct.pack('<Q2I', 0, DIRECT_IO if operation == OPEN else 0, 0)
    if operation == READ:
        _, offset, size = struct.unpack_from('<2QI', body)
        return (channel.read(NODES[node]) + '\n').encode()[offset:offset + size]
    if operation == WRITE:
        size, = struct.unpack_from('<I', body, 16)
        text = body[40:40 + size].decode().strip()
        try:
            channel.write(NODES[node], text)
            verdict = 'taken'
        except Refused:
            verdict = 'refused'
            raise
        finally:
            print(NODES[node], text, verdict, *channel.state.values(), file=log, flush=True)
        return struct.pack('<2I', size, 0)
    if operation in (READDIR, RELEASE, RELEASEDIR, FLUSH):
        return b''
    raise Refused(errno.ENOSYS)


def main():
    folder, log_name, *left = sys.argv[1:]
    channel = Channel(left)
    device = os.open('/dev/fuse', os.O_RDWR)
    os.set_inheritable(device, True)
    subprocess.check_call(['mount', '-i', '-t', 'fuse', '-o', f'fd={device},rootmode=40000,user_id=0,group_id=0,allow_other',
                           'pwm', folder], close_fds=False)

    def end(*_):
        subprocess.call(['umount', '-l', folder])
        sys.exit(0)

    signal.signal(signal.SIGTERM, end)
    with open(log_name, 'w') as log:
        while True:
            request = os.read(device, 1 << 17)
            _, operation, unique, node = struct.unpack_from('<2I2Q', request)
            if operation in (FORGET, BATCH_FORGET, INTERRUPT):
                continue
            error, data = 0, b''
            try:
                data = answer(channel, log, operation, node, request[40:])
            except Refused as refusal:
                error = -refusal.args[0]
            os.write(device, struct.pack('<IiQ', 16 + len(data), error, unique) + data)


main()
