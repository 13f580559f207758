# SPDX-License-Identifier: BSD-3-Clause
"""A bench with an independent simulated drive (strict_node.py)."""
import os
import pathlib
import subprocess
import unittest

from bench import (BUS, JOINT, MODES, Daemon, daemon_toml, joint_state, joint_toml, make_bus, must, remove_bus, wait_until)

# An interpreter cannot answer within every millisecond.
PATIENT = 'zero_torque_after = 100\nquick_stop_after = 1000\n'
SUPERVISION = '\n[joint.supervision]\nmissed_readings_limit = 1000\n'


class StrictBench(unittest.TestCase):
    def setUp(self):
        make_bus()
        self.addCleanup(remove_bus)

    def start_node(self, *options, log='strict.log'):
        process = subprocess.Popen(['chrt', '-f', '50', 'python3', '-B', 'strict_node.py', BUS, '3', '--log', log, *options])
        self.addCleanup(lambda: (process.kill(), process.wait()))
        wait_until(lambda: os.path.exists(log) and ' off' in pathlib.Path(log).read_text(), 10, 'the node runs')
        return process

    def start_daemon(self, can='', **more):
        daemon = Daemon(daemon_toml([joint_toml(can=PATIENT + can) + SUPERVISION]), name=self.id().split('.')[-1], **more)
        self.addCleanup(lambda: daemon.process.poll() is None and daemon.kill())
        return daemon

    @staticmethod
    def done_to(log='strict.log'):
        return [line.split(' ', 1)[1] for line in pathlib.Path(log).read_text().splitlines()]

    def enable(self):
        must('enable', JOINT, timeout_s=10)
        self.assertEqual(joint_state()['mode'], MODES['holding'])
