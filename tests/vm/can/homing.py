# SPDX-License-Identifier: BSD-3-Clause
"""A joint with an incremental encoder is homed on the bus by the encoder's index, which touch probe 1 of the drive latches.
Also tests a search whose index never comes, and the position after a restart of the drive."""
import math
import time
import unittest

from bench import (JOINT, MODES, Daemon, Drive, ctl, daemon_toml, joint_state, joint_toml, make_bus, must, remove_bus,
                   show_and_exit, wait_until)

HOMING_FAILED = 19
NOT_HOMED = 64
INDEX_RAD = 2 * math.pi / 50    # the drive's next index: one comes in each turn of the motor, one of them is at 0
STARTS_AT_RAD = 0.05
HOME_RAD = 0.5
TRAVEL_RAD = 0.3
COUNT_RAD = 2 * math.pi / 320000

INDEX = f'''
[joint.can.inputs]
index = "encoder"

[joint.homing]
to = "index"
direction = "positive"
position_rad = {HOME_RAD}
speed_rad_s = 0.1
travel_rad = {TRAVEL_RAD}
'''


class IndexHoming(unittest.TestCase):
    def setUp(self):
        make_bus()
        self.drive = Drive(options=['--initial-position_rad', str(STARTS_AT_RAD)])
        toml = daemon_toml([joint_toml().replace('encoder = "absolute"', 'encoder = "incremental"'), INDEX])
        self.daemon = Daemon(toml, name=self.id().split('.')[-1])

    def tearDown(self):
        self.daemon.end()
        self.drive.end()
        remove_bus()

    def true_rad(self):
        return float(self.drive.report()['position_rad'])

    def homed(self):
        return joint_state()['notices'] & NOT_HOMED == 0

    def home(self):
        must('home', JOINT, timeout_s=20)
        self.assertEqual(joint_state()['mode'], MODES['holding'])
        self.assertTrue(self.homed())
        time.sleep(0.5)    # waits until state and report show the same position

    def expect_no_position(self):
        self.assertFalse(self.homed())
        status, text = ctl('move', JOINT, '0.6')
        self.assertNotEqual(status, 0)
        self.assertIn('home it first', text)

    def test_the_index_is_where_the_configuration_says_and_a_restart_forgets_it(self):
        must('enable', JOINT)
        self.expect_no_position()
        self.home()
        # The latched position must not depend on how far the joint moved on or how late TPDO3 came.
        self.assertAlmostEqual(joint_state()['joint_position_rad'] - HOME_RAD, self.true_rad() - INDEX_RAD,
                               delta=2 * COUNT_RAD)
        must('move', JOINT, '0.6', '--wait')
        self.assertAlmostEqual(self.true_rad() - INDEX_RAD, 0.1, delta=2e-4)

        self.drive.tell('reboot 30')
        wait_until(lambda: joint_state()['mode'] == MODES['faulted'], 3, 'the restart is seen')
        must('clear-fault', JOINT)
        time.sleep(0.5)
        must('enable', JOINT)
        self.expect_no_position()
        # The joint stands beyond that index. The next index is one motor turn farther and now gets the home position.
        self.home()
        self.assertAlmostEqual(joint_state()['joint_position_rad'] - HOME_RAD, self.true_rad() - 2 * INDEX_RAD,
                               delta=2 * COUNT_RAD)

    def test_an_index_that_never_comes_is_a_fault_and_no_motion_without_end(self):
        self.drive.tell('pretend 0x60B9 0 1')    # the probe is armed but latches nothing
        must('enable', JOINT)
        status, text = ctl('home', JOINT, timeout_s=20)
        self.assertNotEqual(status, 0)
        self.assertIn('homing failed', text)
        state = joint_state()
        self.assertEqual(state['fault'], HOMING_FAILED, self.daemon.text()[-400:])
        time.sleep(0.3)
        report = self.drive.report()
        self.assertNotEqual(report['power'], 'OperationEnabled')
        self.assertEqual(float(report['torque_Nm']), 0.0)
        self.assertGreater(self.true_rad(), STARTS_AT_RAD + 0.9 * TRAVEL_RAD)
        self.assertLess(self.true_rad(), STARTS_AT_RAD + 1.1 * TRAVEL_RAD)
        self.assertFalse(self.homed())

        self.drive.tell('pretend nothing')
        must('clear-fault', JOINT)
        must('enable', JOINT)
        self.expect_no_position()
        self.home()


show_and_exit([IndexHoming])
