# SPDX-License-Identifier: BSD-3-Clause
"""A joint whose encoder forgets its position, homed on the bus by the encoder's index: the drive latches it with touch probe 1. And
what becomes of a search whose index never comes, and of the position when the drive restarts."""
import math
import time
import unittest

from bench import (JOINT, MODES, Daemon, Drive, ctl, daemon_toml, joint_state, joint_toml, make_bus, must, remove_bus,
                   show_and_exit, wait_until)

HOMING_FAILED = 19
NOT_HOMED = 64
INDEX_RAD = 2 * math.pi / 50    # where the drive's next index is: one comes in each turn of the motor, one of them is at 0
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
        time.sleep(0.5)    # so that state and report are of one place

    def expect_no_position(self):
        self.assertFalse(self.homed())
        status, text = ctl('move', JOINT, '0.6')
        self.assertNotEqual(status, 0)
        self.assertIn('home it first', text)

    def test_the_index_is_where_the_configuration_says_and_a_restart_forgets_it(self):
        must('enable', JOINT)
        self.expect_no_position()
        self.home()
        # However far the joint went on, and however late TPDO3 told: the place is the drive's.
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
        # It stands beyond that index: the next one is a turn of the motor farther, and is where the first was said to be.
        self.home()
        self.assertAlmostEqual(joint_state()['joint_position_rad'] - HOME_RAD, self.true_rad() - 2 * INDEX_RAD,
                               delta=2 * COUNT_RAD)

    def test_an_index_that_never_comes_is_a_fault_and_no_motion_without_end(self):
        self.drive.tell('pretend 0x60B9 0 1')    # armed, and nothing latched
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
