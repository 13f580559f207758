# SPDX-License-Identifier: BSD-3-Clause
"""The real strainwaved and strainwavectl with simulated drives on a vcan bus, for the tests of this folder. Everything runs in
the guest's virtual time, so instants may be asserted; utime is microseconds of CLOCK_REALTIME, in messages and records alike.
"""
import csv
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time

FAIL_FAST = False
BUS = 'vcan0'
JOINT = 'elbow'
FAULTS = {name: number for number, name in enumerate(
    ['none', 'read failed', 'write refused', 'drive fault', 'power lost', 'implausible reading', 'link lost',
     'emergency stop', 'drive restarted', 'bus error'])}
MODES = {name: number for number, name in enumerate(['off', 'starting', 'holding', 'tracking', 'stopping', 'faulted'])}

LIMITS = '''
[joint.limits]
position_min_rad = -3.2
position_max_rad = 3.2
speed_limit_rad_s = 6.0
acceleration_rad_s2 = 150
move_speed_share = 1
following_error_rad = 0.2
torque_limit_Nm = 34
'''

# The motor limits of the catalogue's joint at 75 V, as in the simulated drives.
CIA402 = '''
[joint.can]
bus = "arm"
node_id = {node_id}
protocol = "cia402"
encoder = "absolute"
counts_per_output_revolution = 320000
rated_torque_unit = "mNm"
torque_side = "motor"
{can}
[joint.can.identity]
vendor_id = 0xFB
product_code = 0x61500000

[joint.can.motor]
torque_constant_Nm_A = 0.192
back_emf_Vs_rad = 0.190986
resistance_ohm = 4.8
supply_V = 75

[joint.can.temperature]
index = 0x3201
sub_index = 1
type = "int16"
scale_C = 0.1
way = "pdo"
period_s = 0.1
'''

ODRIVE = '''
[joint.can]
bus = "arm"
node_id = {node_id}
protocol = "odrive"
encoder = "absolute"
encoder_turns_per_joint_turn = 50
encoder_counts_per_joint_turn = 320000
torque_side = "motor"
drive_heartbeat_s = 0.02
delay_periods = 0  # on a bus whose frames take no time
{can}
[joint.can.watchdog]
enabled_endpoint = 190
timeout_endpoint = 191

[joint.can.motor]
torque_constant_Nm_A = 0.192
resistance_ohm = 4.8
supply_V = 75
'''


def now_us():
    return time.time_ns() // 1000


def wait_until(condition, timeout_s, what):
    end = time.monotonic() + timeout_s
    pause_s = 0.002
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f'not within {timeout_s} s: {what}')
        # Polls less often the longer it waits, because waking up the interpreter is expensive in a virtual machine.
        time.sleep(pause_s)
        pause_s = min(1.3 * pause_s, 0.05)


def make_bus(name=BUS):
    subprocess.run(['ip', 'link', 'add', 'dev', name, 'type', 'vcan'], check=True)
    subprocess.run(['ip', 'link', 'set', name, 'txqueuelen', '100', 'up'], check=True)


def remove_bus(name=BUS):
    subprocess.run(['ip', 'link', 'delete', name], check=True)


class Drive:
    """A simulated drive in its own process, and its log."""

    def __init__(self, node_id=3, program='./strainwave-can-sim', options=(), bus=BUS):
        self.path = pathlib.Path(f'drive{node_id}.log')
        self.control = f'/tmp/drive{node_id}'
        self.log = open(self.path, 'w')
        # The priority is above the test's own processes, because a real drive has its own processor.
        self.process = subprocess.Popen(
            ['chrt', '-f', '50', program, bus, '--node-id', str(node_id), '--control', self.control, *options],
            stdin=subprocess.DEVNULL, stdout=self.log)
        wait_until(lambda: os.path.exists(self.control), 2, 'the drive runs')

    def tell(self, line):
        """Sends a command and returns its time in microseconds."""
        at_us = now_us()
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
            sender.sendto((line + '\n').encode(), self.control)
        return at_us

    def events(self, since_us=0):
        """Returns (utime, text) of every line since that time."""
        lines = (line.split(' ', 1) for line in self.path.read_text().splitlines())
        return [(int(utime), text) for utime, text in lines if int(utime) >= since_us]

    def find(self, beginning, since_us=0):
        """Returns the utime of the first event with this beginning, or None."""
        return next((utime for utime, text in self.events(since_us) if text.startswith(beginning)), None)

    def wait_for(self, beginning, since_us=0, timeout_s=3.0):
        wait_until(lambda: self.find(beginning, since_us) is not None, timeout_s, f'{self.path.stem}: {beginning}')
        return self.find(beginning, since_us)

    def report(self):
        at_us = self.tell('report')
        self.wait_for('report', at_us)
        text = [text for utime, text in self.events(at_us) if text.startswith('report')][0]
        return dict(word.split('=') for word in text.split()[1:])

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait()


def joint_toml(name=JOINT, node_id=3, driver='can', section=CIA402, can=''):
    text = f'''
[[joint]]
name = "{name}"
joint_model = "rhs17-6006"
model = "rigid"
inertia_kgm2 = 0.089
gear_ratio = 50
driver = "{driver}"
table = "rhs17-6006.json"
{LIMITS}'''
    return text + (section.format(node_id=node_id, can=can) if driver == 'can' else section)


def daemon_toml(joints, state_rate_Hz=200, bus=''):
    text = f'''
[daemon]
period_s = 0.001
real_time = "enforce"
state_rate_Hz = {state_rate_Hz}

[security]
authorized_keys = "authorized_keys"
'''
    if any('driver = "can"' in joint for joint in joints):
        text += f'\n[[can_bus]]\nname = "arm"\ninterface = "{BUS}"\n{bus}\n'
    return text + ''.join(joints)


def make_key():
    if not os.path.exists('key'):
        subprocess.run(['./strainwavectl', 'keygen', '--out', 'key', '--role', 'engineer', '--comment', 'test'], check=True,
                       stdout=subprocess.DEVNULL)
        pathlib.Path('authorized_keys').write_text(pathlib.Path('key.pub').read_text())
        os.chmod('authorized_keys', 0o600)


def ctl(*arguments, timeout_s=3):
    """Runs strainwavectl and returns its exit status and output."""
    done = subprocess.run(['./strainwavectl', '--key', 'key', '--timeout_s', str(timeout_s), *arguments],
                          capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def must(*arguments, timeout_s=3):
    status, text = ctl(*arguments, timeout_s=timeout_s)
    assert status == 0, f'strainwavectl {" ".join(arguments)} ended with {status}: {text}'
    return text


def joint_state(name=JOINT):
    return json.loads(must('status', name, '--json'))['joints'][0]


class Daemon:
    """strainwaved with its configuration and its log."""

    def __init__(self, toml, name='daemon', wait_for=JOINT):
        make_key()
        self.log_path = pathlib.Path(f'{name}.log')
        pathlib.Path(f'{name}.toml').write_text(toml)
        self.process = subprocess.Popen(['./strainwaved', '--config', f'{name}.toml'], stdin=subprocess.DEVNULL,
                                        stdout=open(f'{name}.out', 'w'), stderr=open(self.log_path, 'w'))
        if wait_for:
            self.wait_for(wait_for)

    def wait_for(self, joint):
        # A client that asks before the daemon listens waits for the whole time-out.
        wait_until(lambda: self.process.poll() is not None or ', session ' in self.text(), 10, 'the daemon runs')
        wait_until(lambda: self.process.poll() is not None or ctl('status', joint, timeout_s=0.5)[0] == 0, 10,
                   'the daemon answers')
        assert self.process.poll() is None, 'the daemon ended: ' + self.text()

    def text(self):
        return self.log_path.read_text()

    def hurry_gateway(self):
        """Gives the gateway the highest priority after loop and drives, so that no state is lost at high rates."""
        gateway = subprocess.check_output(['pgrep', '-P', str(self.process.pid)], text=True).split()
        for process in gateway:
            subprocess.run(['chrt', '-a', '-f', '-p', '30', process], check=True)

    def refusal(self, timeout_s=15):
        """Returns the log of a daemon that must refuse to start."""
        status = self.process.wait(timeout_s)
        assert status != 0, 'the daemon ended in order, but was to refuse'
        return self.text()

    def kill(self):
        at_us = now_us()
        self.process.kill()
        self.process.wait()
        return at_us

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(15)


class Recording:
    """Starts strainwavectl record for the joints."""

    def __init__(self, *joints, name='record'):
        self.path = pathlib.Path(f'{name}.lcm')
        self.process = subprocess.Popen(['chrt', '-f', '20', './strainwavectl', 'record', *(joints or (JOINT,)), '--out', self.path, '--overwrite'],
                                        stdout=subprocess.DEVNULL)
        wait_until(lambda: self.path.exists() and self.path.stat().st_size > 0, 3, 'the recording begins')

    def end(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait()
        table = self.path.with_suffix('.csv')
        subprocess.run(['./strainwavectl', 'export', self.path, '--out', table, '--overwrite'], check=True, stdout=subprocess.DEVNULL)
        with open(table) as file:
            return list(csv.DictReader(file))


def first_fault(rows, since_us):
    """Returns (utime, fault) of the first state with a fault after this instant, or None."""
    for row in rows:
        if int(row['utime']) >= since_us and int(row['fault']) != 0:
            return int(row['utime']), int(row['fault'])
    return None


def show_and_exit(tests):
    """Runs unittest cases. Shows every log after a failure, because the guest does not survive the test."""
    import unittest
    suite = unittest.defaultTestLoader.loadTestsFromTestCase
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout, failfast=FAIL_FAST).run(
        unittest.TestSuite(suite(case) for case in tests))
    if not result.wasSuccessful():
        for path in sorted(pathlib.Path('.').glob('*.log')):
            print(f'== {path}')
            print(path.read_text()[-6000:])
    sys.exit(0 if result.wasSuccessful() else 1)
