# SPDX-License-Identifier: BSD-3-Clause
"""Our driver with an independent drive (strict_node.py). It leaves a foreign drive, a slow one and two drives with one id
untouched, and it waits for a drive that boots slowly."""
import signal
import time

from bench import FAULTS, JOINT, MODES, ctl, joint_state, must, show_and_exit, wait_until
from strict_bench import StrictBench


class StrictPeer(StrictBench):
    def test_a_drive_of_another_vendor_is_read_and_left_alone(self):
        self.start_node('--vendor', '0xABC')
        wait_until(lambda: 'boot' in self.done_to(), 2, 'it boots')
        said = self.start_daemon(wait_for=None).refusal(30)
        self.assertIn('vendor', said)
        done = self.done_to()
        self.assertTrue(any(line.startswith('read 1018') for line in done), done)
        self.assertFalse([line for line in done if line.startswith(('write', 'nmt', 'controlword'))], done)

    def test_a_drive_that_obeys_the_standard_to_the_letter_is_set_up_enabled_and_switched_off(self):
        self.start_node()
        daemon = self.start_daemon()
        self.enable()
        time.sleep(1)
        self.assertEqual(joint_state()['mode'], MODES['holding'], daemon.text())
        must('disable', JOINT)
        self.assertEqual(daemon.end(), 0)
        refused = [line for line in self.done_to() if 'refused' in line and '06020000' not in line]
        self.assertFalse(refused, 'nothing was written to a PDO that was valid')
        self.assertNotEqual(self.done_to()[-1], 'controlword F')

    def test_a_drive_that_boots_slowly_is_waited_for_at_the_start_and_after_a_restart(self):
        process = self.start_node('--boot-after', '4')
        daemon = self.start_daemon('boot_timeout_s = 10\n')
        self.enable()
        process.send_signal(signal.SIGUSR1)
        wait_until(lambda: joint_state()['mode'] == MODES['faulted'], 5, 'the joint faults')
        deadline = time.monotonic() + 30
        while joint_state()['mode'] != MODES['off'] or ctl('enable', JOINT, timeout_s=5)[0] != 0:
            ctl('clear-fault', JOINT)
            self.assertLess(time.monotonic(), deadline, 'it never comes back: ' + daemon.text())
            time.sleep(0.5)
        self.assertEqual(joint_state()['mode'], MODES['holding'])

    def test_a_drive_that_answers_after_80_ms_is_started_and_ended_in_time(self):
        self.start_node('--sdo-delay', '0.08')
        begun = time.monotonic()
        daemon = self.start_daemon(wait_for=None)
        wait_until(lambda: ctl('status', JOINT, timeout_s=0.5)[0] == 0, 20, 'the daemon runs: ' + daemon.text())
        print(f'started in {time.monotonic() - begun:.1f} s')
        self.enable()
        begun = time.monotonic()
        self.assertEqual(daemon.end(), 0)
        print(f'ended in {time.monotonic() - begun:.1f} s')
        self.assertNotEqual([line for line in self.done_to() if line.startswith('controlword')][-1], 'controlword F')

    def test_a_drive_that_answers_after_300_ms_is_refused_and_left_alone(self):
        self.start_node('--sdo-delay', '0.3')
        said = self.start_daemon(wait_for=None).refusal(30)
        self.assertIn('at most 100 ms', said)
        self.assertFalse([line for line in self.done_to() if line.startswith(('write', 'nmt', 'controlword'))])

    def test_two_drives_with_one_id_are_noticed_before_either_is_changed(self):
        self.start_node(log='first.log')
        self.start_node(log='second.log')
        wait_until(lambda: 'boot' in self.done_to('second.log'), 2, 'it boots')
        self.assertIn('two nodes answer', self.start_daemon(wait_for=None).refusal(30))
        for log in ('first.log', 'second.log'):
            done = self.done_to(log)
            self.assertFalse([line for line in done if line.startswith(('write', 'nmt', 'controlword'))], done)

    def test_positions_that_come_later_than_is_allowed_for_are_refused_at_the_start(self):
        self.start_node('--tpdo-delay', '0.0104')
        said = self.start_daemon('delay_periods = 2\n', wait_for=None).refusal(30)
        self.assertIn('delay_periods', said)

    def test_positions_that_become_later_than_is_allowed_for_are_a_fault(self):
        process = self.start_node('--late', '0.0104', '--torque-lag', '1', '--track', 'track')
        daemon = self.start_daemon('delay_periods = 2\n')
        self.enable()
        process.send_signal(signal.SIGUSR2)
        wait_until(lambda: joint_state()['mode'] == MODES['faulted'], 3, 'the joint faults: ' + daemon.text())
        self.assertEqual(joint_state()['fault'], FAULTS['read failed'])
        self.assertIn('us after their SYNC', daemon.text())
        self.assertNotEqual([line for line in self.done_to() if line.startswith('controlword')][-1], 'controlword F')


show_and_exit([StrictPeer])
