# SPDX-License-Identifier: BSD-3-Clause
"""A joint with an ODrive: start-up, motion and failures. After a SIGKILL of the daemon only the drive's watchdog remains."""
import time
import unittest

from bench import (FAULTS, JOINT, MODES, ODRIVE, Daemon, Drive, Recording, ctl, daemon_toml, first_fault, joint_state,
                   joint_toml, make_bus, must, remove_bus, show_and_exit, wait_until)

HEARTBEAT_US = 20000
WATCHDOG_US = 100000
PERIOD_US = 1000
STATE_US = 5000
FAULT_AFTER = 10
WAKE_US = 200  # latency of a process that waits for an instant
OPTIONS = ['--encoder_ms', '1', '--torques_ms', '1', '--temperature_ms', '100', '--heartbeat_ms', '20', '--watchdog_s', '0.1',
           '--input-vel-scale', '500']


def make_daemon(name, can=''):
    return Daemon(daemon_toml([joint_toml(section=ODRIVE, can=can)], bus='sync = "none"'), name=name, wait_for=None)


def start_moving(drive):
    must('enable', JOINT)
    must('move', JOINT, '3.0')
    wait_until(lambda: float(drive.report()['velocity_rad_s']) > 2.0, 2, 'the joint moves')


class Odrive(unittest.TestCase):
    def setUp(self):
        make_bus()
        self.drive = Drive(3, './odrive-node', OPTIONS)
        time.sleep(0.1)

    def tearDown(self):
        self.drive.end()
        remove_bus()

    def start(self, can=''):
        daemon = make_daemon(self.id().split('.')[-1], can)
        daemon.wait_for(JOINT)
        self.addCleanup(lambda: daemon.process.poll() is None and daemon.kill())
        return daemon

    def expect_fault(self, rows, since_us, name, within_us):
        fault = first_fault(rows, since_us)
        self.assertIsNotNone(fault, 'no fault at all')
        self.assertEqual(fault[1], FAULTS[name])
        self.assertLessEqual(fault[0] - since_us, within_us + STATE_US)

    def test_a_joint_is_brought_up_moved_and_shut_down(self):
        daemon = self.start()
        self.assertIn('firmware 0.6.10', daemon.text())
        self.assertIn('its watchdog stops it after 0.100 s', daemon.text())
        must('enable', JOINT)
        for setpoint_rad in (0.01, 0.1, 1.0):
            must('move', JOINT, str(setpoint_rad), '--wait')
            # The trajectory has ended. The control law comes closer by its integral action.
            time.sleep(0.5)
            self.assertAlmostEqual(float(self.drive.report()['position_rad']), setpoint_rad, delta=3e-4)
        must('disable', JOINT)
        self.assertEqual(joint_state()['mode'], MODES['off'])
        self.assertEqual(daemon.end(), 0, daemon.text())
        self.assertEqual(self.drive.report()['state'], '1')

    def move_by_its_own_loop(self, drive_mode):
        # At 6 rad/s the motor makes 48 turns a second, too many for thousandths in 16 bits.
        daemon = self.start(f'drive_mode = "{drive_mode}"\ninput_vel_scale = 500')
        must('enable', JOINT)
        self.assertAlmostEqual(float(self.drive.report()['position_rad']), 0.0, delta=3e-4)
        for setpoint_rad in (0.1, 1.0, 0.0):
            must('move', JOINT, str(setpoint_rad), '--wait')
            time.sleep(0.5)
            self.assertAlmostEqual(float(self.drive.report()['position_rad']), setpoint_rad, delta=3e-4)
        must('disable', JOINT)
        self.assertEqual(daemon.end(), 0, daemon.text())
        self.assertIn('stability is not proved', daemon.text())

    def test_a_joint_whose_drive_closes_a_loop_of_position_arrives(self):
        self.move_by_its_own_loop('position')

    def test_a_joint_whose_drive_closes_a_loop_of_velocity_arrives(self):
        self.move_by_its_own_loop('velocity')

    def test_start_up_refuses_another_firmware(self):
        self.drive.tell('firmware 0 5 6')
        self.assertIn('firmware = 0.5.6', make_daemon('refused').refusal())

    def test_an_error_of_the_axis_is_a_fault_with_its_name(self):
        daemon = self.start()
        recording = Recording()
        start_moving(self.drive)
        at_us = self.drive.tell('error 0x2000')
        time.sleep(0.2)
        self.expect_fault(recording.end(), at_us, 'drive fault', HEARTBEAT_US + 2 * PERIOD_US)
        self.assertIn('MOTOR_OVER_TEMP', daemon.text())
        self.assertNotEqual(ctl('enable', JOINT)[0], 0)
        must('clear-fault', JOINT)
        must('enable', JOINT)
        must('disable', JOINT)

    def test_a_cut_cable_is_a_fault_and_the_watchdog_takes_the_torque(self):
        self.start()
        recording = Recording()
        start_moving(self.drive)
        at_us = self.drive.tell('cut')
        # The watchdog counts from the last torque frame before the cut, which came up to a period earlier.
        cut_us = self.drive.wait_for('told cut', at_us)
        expired_us = self.drive.wait_for('error 01000000', at_us)
        self.assertLessEqual(expired_us - cut_us, WATCHDOG_US + WAKE_US)
        self.assertGreaterEqual(expired_us - cut_us, WATCHDOG_US - PERIOD_US - WAKE_US)
        self.expect_fault(recording.end(), at_us, 'read failed', (FAULT_AFTER + 3) * PERIOD_US)
        self.drive.wait_for('at-rest', at_us)
        self.drive.tell('reconnect')
        time.sleep(0.2)
        must('clear-fault', JOINT)
        time.sleep(0.2)
        must('enable', JOINT)
        must('disable', JOINT)

    def test_a_daemon_that_is_killed_while_it_moves_leaves_the_watchdog_to_take_the_torque(self):
        daemon = self.start()
        start_moving(self.drive)
        killed_us = daemon.kill()
        expired_us = self.drive.wait_for('error 01000000', killed_us)
        self.assertLessEqual(expired_us - killed_us, WATCHDOG_US + WAKE_US)
        self.assertGreaterEqual(expired_us - killed_us, WATCHDOG_US - 2 * PERIOD_US)
        self.drive.wait_for('at-rest', killed_us)
        self.assertEqual(float(self.drive.report()['torque_Nm']), 0.0)


show_and_exit([Odrive])
