# SPDX-License-Identifier: BSD-3-Clause
"""strainwaved --commission with a drive on a bus. It moves the joint in real time and measures its friction, and a key brakes and disables.
The test leaves out the fit, because the simulated joint has no spring."""
import json
import math
import os
import pathlib
import pty
import subprocess
import time
import unittest

from bench import CIA402, JOINT, Drive, daemon_toml, joint_toml, make_bus, show_and_exit, wait_until

INTERRUPTED = 130


def flexible_toml():
    """A configuration with the spring of the gear and a low speed, without inertia and gain table."""
    text = joint_toml(section=CIA402, can='encoder_side = "motor"')
    for before, after in (
            ('model = "rigid"\ninertia_kgm2 = 0.089\n', 'model = "flexible"\ngear = "csf-17-50"\n'),
            ('table = "rhs17-6006.json"\n', ''),
            ('speed_limit_rad_s = 6.0', 'speed_limit_rad_s = 3.0')):
        assert before in text, before
        text = text.replace(before, after)
    return daemon_toml([text])


def friction_Nm(speed_rad_s, temperature_C):
    """Friction of the simulated joint at speeds above the Stribeck curve: docs/theory.md, section 3."""
    cold = math.exp(-(temperature_C + 12.803) / 11.28)
    ratio = 50
    motor_rpm = ratio * speed_rad_s * 60 / (2 * math.pi)
    return ratio / 100 * (1.5204 + 6.6525 * cold + (0.0011702 + 0.01181 * cold) * motor_rpm)


class Commissioning:
    """A run in a terminal, with its output in FOLDER.log."""

    def __init__(self, folder):
        pathlib.Path('joint.toml').write_text(flexible_toml())
        self.log = pathlib.Path(f'{folder}.log')
        self.keyboard, terminal = pty.openpty()
        self.process = subprocess.Popen(['./strainwaved', '--config', 'joint.toml', '--commission', JOINT, '--out', folder],
                                        stdin=terminal, stdout=self.log.open('w'), stderr=subprocess.STDOUT)
        os.close(terminal)

    def lines(self):
        return self.log.read_text()


def record(folder):
    return json.loads((pathlib.Path(folder) / 'commission.json').read_text())


class Commission(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        make_bus()

    def test_measures_friction_and_a_key_brakes_and_disables(self):
        drive = Drive()
        run = Commissioning('interrupted')
        wait_until(lambda: '\nmotion: ' in run.lines() or run.process.poll() is not None, 240, 'the shaken strokes have begun')
        time.sleep(1)
        os.write(run.keyboard, b'\x13')  # Ctrl-S works as well as any other key
        self.assertEqual(run.process.wait(20), INTERRUPTED, run.lines())
        self.assertNotEqual(drive.report()['power'], 'OperationEnabled')
        self.assertEqual(float(drive.report()['torque_Nm']), 0.0)
        self.assertIsNone(drive.find('heartbeat-lost'))
        found = record('interrupted')
        self.assertEqual(found['problem'], 'interrupted by a key')
        outcomes = {step['name']: step['outcome'] for step in found['steps']}
        self.assertEqual([outcomes[name] for name in ('identity', 'direction', 'breakaway', 'friction', 'motion')],
                         ['done', 'done', 'done', 'done', 'failed'])
        self.assertGreaterEqual(len(found['friction']), 3)
        for point in found['friction']:
            truth_Nm = friction_Nm(point['speed_rad_s'], point['temperature_C'])
            self.assertAlmostEqual(point['torque_Nm'] / truth_Nm, 1.0, delta=0.03, msg=point)
        drive.end()

    def test_a_real_joint_is_not_moved_without_a_terminal(self):
        pathlib.Path('joint.toml').write_text(flexible_toml())
        run = subprocess.run(['./strainwaved', '--config', 'joint.toml', '--commission', JOINT, '--out', 'none'],
                             stdin=subprocess.DEVNULL, capture_output=True, text=True)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn('not a terminal', run.stdout + run.stderr)


show_and_exit([Commission])
