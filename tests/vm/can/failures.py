# SPDX-License-Identifier: BSD-3-Clause
"""Provokes every failure of a drive and its bus, and checks the reactions of daemon and drive and their times. The way
back is always the same: an operator clears the fault and enables."""
import subprocess
import time
import unittest

from bench import (BUS, FAULTS, JOINT, MODES, Daemon, Drive, Recording, ctl, daemon_toml, first_fault, joint_state,
                   joint_toml, make_bus, must, now_us, remove_bus, show_and_exit, wait_until)

# Defaults of the configuration, in microseconds or periods.
PERIOD_US = 1000
STATE_US = 5000
ZERO_TORQUE_AFTER = 2
QUICK_STOP_AFTER = 4
HEARTBEAT_US = 50000
MASTER_TIMEOUT_US = 150000
STATUS_US = 10000
POSITION_LATE = 1024


def start_moving(drive):
    """Starts a move from 0 that needs torque all the time."""
    must('enable', JOINT)
    must('move', JOINT, '3.0')
    wait_until(lambda: float(drive.report()['velocity_rad_s']) > 2.0, 2, 'the joint moves')


class Failures(unittest.TestCase):
    def setUp(self):
        name = self.id().split('.')[-1]
        make_bus()
        self.drive = Drive()
        self.daemon = Daemon(daemon_toml([joint_toml()]), name=name)
        self.recording = Recording(name=name)
        start_moving(self.drive)

    def tearDown(self):
        self.daemon.end()
        self.drive.end()
        remove_bus()

    def expect_fault(self, since_us, names, within_us):
        """Checks the fault of the daemon, which must have one of these names, and its time in the states."""
        time.sleep(0.3)
        rows = self.recording.end()
        fault = first_fault(rows, since_us)
        self.assertIsNotNone(fault, 'no fault at all')
        names = (names,) if isinstance(names, str) else names
        self.assertIn(fault[1], [FAULTS[name] for name in names], self.daemon.text()[-400:])
        # States are samples, so the fault came up to one state period earlier.
        self.assertLessEqual(fault[0] - since_us, within_us + STATE_US)
        self.assertEqual(joint_state()['mode'], MODES['faulted'])

    def expect_rest(self, since_us, within_us):
        """Checks that the drive has no power and no torque, and stands still."""
        at_rest_us = self.drive.wait_for('at-rest', since_us)
        self.assertLessEqual(at_rest_us - since_us, within_us)
        report = self.drive.report()
        self.assertNotEqual(report['power'], 'OperationEnabled')
        self.assertEqual(float(report['torque_Nm']), 0.0)
        self.assertEqual(float(report['velocity_rad_s']), 0.0)

    def expect_way_back(self):
        """Checks that only an operator can recover: enabling alone is refused."""
        self.assertNotEqual(ctl('enable', JOINT)[0], 0)
        time.sleep(0.05)
        self.assertNotEqual(self.drive.report()['power'], 'OperationEnabled')
        must('clear-fault', JOINT)
        time.sleep(0.25)  # the daemon sets up a restarted drive again
        must('enable', JOINT)
        # A small move shows that the drive obeys.
        must('move', JOINT, str(float(self.drive.report()['position_rad']) - 0.05), '--wait')
        must('disable', JOINT)

    def test_an_emergency_stops_the_joint_at_once(self):
        at_us = self.drive.tell('emcy 0x4210')
        self.expect_fault(at_us, 'drive fault', 2 * PERIOD_US)
        self.expect_rest(at_us, 300000)
        self.assertIn('4210h', self.daemon.text())
        self.expect_way_back()

    def test_a_drive_that_vanishes_stops_itself_and_is_missed(self):
        at_us = self.drive.tell('cut')
        lost_us = self.drive.wait_for('heartbeat-lost', at_us)
        self.assertLessEqual(lost_us - at_us, MASTER_TIMEOUT_US)
        self.assertGreaterEqual(lost_us - at_us, MASTER_TIMEOUT_US - HEARTBEAT_US - PERIOD_US)
        self.expect_fault(at_us, 'read failed', (QUICK_STOP_AFTER + 2) * PERIOD_US)
        self.assertIsNotNone(self.drive.find('power QuickStopActive', at_us))
        self.expect_rest(at_us, MASTER_TIMEOUT_US + 300000)
        self.drive.tell('reconnect')
        time.sleep(0.2)
        self.expect_way_back()

    def test_a_few_missing_positions_are_forgiven(self):
        self.drive.tell(f'skip-tpdo {ZERO_TORQUE_AFTER}')
        time.sleep(0.3)
        self.assertIsNone(first_fault(self.recording.end(), 0))
        must('disable', JOINT)

    def test_missing_positions_take_the_torque_before_they_are_a_fault(self):
        self.drive.tell('note-torque on')
        at_us = self.drive.tell('skip-tpdo 200')
        self.expect_fault(at_us, 'read failed', (QUICK_STOP_AFTER + 3) * PERIOD_US)
        zero_us = self.drive.find('torque zero', at_us)
        # One period passes until the drive has the command and a SYNC applies it.
        self.assertLessEqual(zero_us - at_us, (ZERO_TORQUE_AFTER + 3) * PERIOD_US)
        self.assertGreaterEqual(zero_us - at_us, ZERO_TORQUE_AFTER * PERIOD_US)
        # The stop goes by SDO, because the daemon does not know whether the drive takes process data.
        off_us = self.drive.find('power SwitchOnDisabled', at_us)
        self.assertLessEqual(off_us - at_us, (QUICK_STOP_AFTER + 4) * PERIOD_US)
        self.drive.tell('note-torque off')
        self.expect_rest(at_us, 400000)
        self.expect_way_back()

    def test_a_drive_that_restarts_is_set_up_again_on_order_only(self):
        at_us = self.drive.tell('reboot 30')
        self.expect_fault(at_us, 'read failed', (QUICK_STOP_AFTER + 3) * PERIOD_US)
        self.assertIsNotNone(self.drive.find('nmt pre-operational', at_us))
        self.assertEqual(self.drive.report()['nmt'], 'pre-operational', 'nobody starts it by himself')
        self.expect_rest(at_us, 2000000)
        self.expect_way_back()
        self.assertEqual(self.drive.report()['nmt'], 'operational')

    def test_a_boot_up_in_the_midst_of_operation_is_a_fault(self):
        at_us = now_us()
        subprocess.run(['cansend', BUS, '703#00'], check=True)
        self.expect_fault(at_us, 'drive restarted', 10 * PERIOD_US)
        self.expect_way_back()

    def test_a_drive_without_heartbeat_is_lost(self):
        at_us = self.drive.tell('heartbeat off')
        self.expect_fault(at_us, 'link lost', 3 * HEARTBEAT_US + PERIOD_US)
        self.drive.tell('heartbeat on')
        time.sleep(0.2)
        self.expect_way_back()

    def test_another_mode_of_operation_is_a_fault(self):
        at_us = self.drive.tell('pretend 0x6061 0 8')
        self.expect_fault(at_us, 'write refused', STATUS_US + 2 * PERIOD_US)
        self.assertIn('mode of operation 8', self.daemon.text())
        self.expect_rest(at_us, 400000)
        self.drive.tell('pretend nothing')
        time.sleep(0.1)
        self.expect_way_back()

    def test_somebody_else_who_sends_our_orders_is_a_fault(self):
        at_us = now_us()
        subprocess.run(['cansend', BUS, '203#0F00E803'], check=True)
        self.expect_fault(at_us, 'write refused', 10 * PERIOD_US)
        self.assertIn('0203h', self.daemon.text())
        self.expect_way_back()

    def test_somebody_who_makes_the_drive_pre_operational_takes_its_torque_and_gives_none(self):
        self.drive.tell('note-torque on')
        at_us = now_us()
        subprocess.run(['cansend', BUS, '000#8003'], check=True)
        # The drive's next heartbeat, which may come first, reports the state.
        self.expect_fault(at_us, ('read failed', 'drive restarted'), (QUICK_STOP_AFTER + 3) * PERIOD_US + STATE_US)
        # A pre-operational drive still obeys an SDO.
        off_us = self.drive.find('power SwitchOnDisabled', at_us)
        self.assertIsNotNone(off_us)
        self.assertLessEqual(off_us - at_us, (QUICK_STOP_AFTER + 6) * PERIOD_US)
        self.drive.tell('note-torque off')
        self.expect_rest(at_us, 400000)
        self.expect_way_back()

    def test_a_flood_of_foreign_frames_is_not_noticed(self):
        self.drive.tell('clear')
        subprocess.run(['cangen', BUS, '-g', '0.05', '-I', '123', '-L', '8', '-n', '4000'], check=True)
        self.assertIsNone(first_fault(self.recording.end(), 0))
        self.assertEqual(int(self.drive.report()['syncs_without_rpdo']), 0)
        must('disable', JOINT)

    def test_an_interface_that_goes_down_is_a_fault_and_only_the_stop_is_sent_when_it_returns(self):
        at_us = now_us()
        subprocess.run(['ip', 'link', 'set', BUS, 'down'], check=True)
        self.drive.wait_for('power QuickStopActive', at_us)
        self.expect_fault(at_us, 'link lost', 10 * PERIOD_US)
        self.expect_rest(at_us, MASTER_TIMEOUT_US + 300000)
        up_us = now_us()
        subprocess.run(['ip', 'link', 'set', BUS, 'up'], check=True)
        time.sleep(0.3)
        self.assertIsNone(self.drive.find('power OperationEnabled', up_us), 'an order from before')
        self.expect_way_back()


class LatePositions(unittest.TestCase):
    """TPDO1 becomes later than it was at the start."""

    def setUp(self):
        make_bus()
        self.drive = Drive()

    def tearDown(self):
        self.daemon.end()
        self.drive.end()
        remove_bus()

    def rows_with_lateness(self, late_us, delay_periods):
        """Returns the states from 0.1 s after the lateness began. The gap before the first late TPDO1 is no fault here."""
        name = self.id().split('.')[-1]
        can = f'delay_periods = {delay_periods}\nquick_stop_after = 20\n[joint.supervision]\nmissed_readings_limit = 20'
        self.daemon = Daemon(daemon_toml([joint_toml(can=can)]), name=name)
        recording = Recording(name=name)
        must('enable', JOINT)
        time.sleep(0.3)
        at_us = self.drive.tell(f'late-tpdo {late_us} 100000')
        time.sleep(0.5)
        rows = recording.end()
        self.assertFalse(any(int(row['notices']) & POSITION_LATE for row in rows if int(row['utime']) < at_us))
        return [row for row in rows if int(row['utime']) > at_us + 100000]

    def test_1_4_ms_are_a_notice_where_the_configuration_allows_for_them(self):
        rows = self.rows_with_lateness(1400, 2)
        self.assertTrue(all(int(row['notices']) & POSITION_LATE for row in rows))
        self.assertIsNone(first_fault(rows, 0))
        must('disable', JOINT)

    def test_1_4_ms_are_a_fault_where_it_allows_for_one(self):
        self.expect_fault(self.rows_with_lateness(1400, 1))

    def test_10_4_ms_are_a_fault_whatever_it_allows_for(self):
        self.expect_fault(self.rows_with_lateness(10400, 2))  # the table allows no longer delay

    def expect_fault(self, rows):
        self.assertTrue(all(int(row['fault']) == FAULTS['read failed'] for row in rows))
        self.assertIn('us after their SYNC', self.daemon.text())
        self.assertEqual(float(self.drive.report()['torque_Nm']), 0.0)


class EndAndBeginning(unittest.TestCase):
    def setUp(self):
        make_bus()
        self.drive = Drive()
        wait_until(lambda: self.drive.report()['nmt'] == 'pre-operational', 1, 'the drive has booted')

    def tearDown(self):
        self.drive.end()
        remove_bus()

    def test_a_daemon_that_is_killed_while_it_moves_leaves_a_drive_that_stops_itself(self):
        drive = self.drive
        daemon = Daemon(daemon_toml([joint_toml()]), name='killed')
        start_moving(drive)
        killed_us = daemon.kill()
        lost_us = drive.wait_for('heartbeat-lost', killed_us)
        self.assertLessEqual(lost_us - killed_us, MASTER_TIMEOUT_US)
        self.assertGreaterEqual(lost_us - killed_us, MASTER_TIMEOUT_US - HEARTBEAT_US - PERIOD_US)
        # The deadline of RPDO1 is shorter than the time-out of the heartbeat.
        self.assertLessEqual(drive.wait_for('power QuickStopActive', killed_us) - lost_us, PERIOD_US)
        at_rest_us = drive.wait_for('at-rest', killed_us)
        self.assertLessEqual(at_rest_us - lost_us, 200000)
        drive.wait_for('power SwitchOnDisabled', killed_us)  # one period after the joint came to rest
        report = drive.report()
        self.assertEqual((report['power'], float(report['torque_Nm'])), ('SwitchOnDisabled', 0.0))

    def test_an_interface_that_is_down_for_a_moment_carries_the_stop_to_a_drive_without_deadline(self):
        self.drive.tell('refuse 0x1400 5 0x06090011')
        daemon = Daemon(daemon_toml([joint_toml()]), name='moment')
        try:
            start_moving(self.drive)
            down_us = now_us()
            subprocess.run(['ip', '-batch', '-'], input=f'link set {BUS} down\nlink set {BUS} up\n', text=True, check=True)
            stopped_us = self.drive.wait_for('power ', down_us)
            self.assertLess(stopped_us - down_us, MASTER_TIMEOUT_US - HEARTBEAT_US)
            self.drive.wait_for('at-rest', down_us)
            self.assertIsNone(self.drive.find('heartbeat-lost', down_us), 'the daemon stopped it, not its own supervision')
        finally:
            daemon.end()

    def test_start_up_refuses_another_drive_than_the_configured_one(self):
        self.assertIn('product', self.refusal('pretend 0x1018 2 0x99'))

    def test_start_up_refuses_a_rated_torque_in_another_unit(self):
        text = self.refusal('pretend 0x6076 0 192000')
        self.assertIn('uNm', text)

    def test_start_up_refuses_a_drive_that_does_not_keep_its_supervision(self):
        self.assertIn('1016h', self.refusal('refuse 0x1016 1 0x06010002'))

    def test_start_up_refuses_a_drive_that_is_not_there(self):
        self.assertIn('node 3', self.refusal('cut'))

    def refusal(self, line):
        self.drive.tell(line)
        daemon = Daemon(daemon_toml([joint_toml()]), name='refused', wait_for=None)
        text = daemon.refusal()
        self.assertIsNone(self.drive.find('power ReadyToSwitchOn'))
        return text


show_and_exit([Failures, LatePositions, EndAndBeginning])
