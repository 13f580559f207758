# SPDX-License-Identifier: BSD-3-Clause
"""How exactly a joint with an independent drive (strict_node.py) swings: on time, and with late positions or torques."""
import pathlib
import signal
import time

from bench import JOINT, joint_state, must, now_us, show_and_exit
from strict_bench import StrictBench

POSITION_LATE = 1024


class StrictSwings(StrictBench):
    def swing(self):
        """Moves there and back. Returns the largest true overshoot beyond the targets and the largest true error while holding, in mrad."""
        beyond_mrad, off_mrad = 0.0, 0.0
        for target_rad, side in ((0.3, 1), (0.0, -1)):
            at_us = now_us()
            must('move', JOINT, str(target_rad))
            time.sleep(0.7)
            for line in pathlib.Path('track').read_text().splitlines():
                utime, position_rad = int(line.split()[0]), float(line.split()[1])
                if utime > at_us:
                    beyond_mrad = max(beyond_mrad, 1e3 * side * (position_rad - target_rad))
                if utime > at_us + 500000:
                    off_mrad = max(off_mrad, 1e3 * abs(position_rad - target_rad))
        return beyond_mrad, off_mrad

    def expect_exact_swings(self, notices, on_time=False, count=2):
        # With a delay, a torque pulse is over before its effect shows. The joint may overshoot by a milliradian, and the next pulse returns it.
        for number in range(count):
            beyond_mrad, off_mrad = self.swing()
            state = joint_state()
            told = (f'swing {number}: beyond the target by {beyond_mrad:.3f} mrad, holds {off_mrad:.3f} mrad off it, '
                    f'notices {state["notices"]}')
            print(told)
            self.assertLess(beyond_mrad, 0.2 if on_time else 2, told)
            self.assertLess(off_mrad, 0.1, told)
            self.assertEqual(state['notices'], notices, told)

    def test_a_joint_whose_positions_are_on_time_is_exact(self):
        self.start_node('--track', 'track')
        self.start_daemon()
        self.enable()
        self.expect_exact_swings(notices=0, on_time=True)

    def test_a_joint_whose_torques_act_a_period_late_is_exact(self):
        self.start_node('--torque-lag', '1', '--track', 'track')
        self.start_daemon('delay_periods = 2\n')
        self.enable()
        self.expect_exact_swings(notices=0)

    def test_a_joint_whose_positions_are_1_4_ms_late_from_the_start_is_exact(self):
        self.start_node('--tpdo-delay', '0.0014', '--track', 'track')
        self.start_daemon('delay_periods = 2\n')
        self.enable()
        self.expect_exact_swings(notices=POSITION_LATE)

    def test_a_joint_whose_positions_become_1_4_ms_late_in_operation_is_exact_and_says_so(self):
        process = self.start_node('--late', '0.0014', '--torque-lag', '1', '--track', 'track')
        self.start_daemon('delay_periods = 2\n')
        self.enable()
        self.expect_exact_swings(notices=0)
        process.send_signal(signal.SIGUSR2)
        time.sleep(0.5)
        self.expect_exact_swings(notices=POSITION_LATE)


show_and_exit([StrictSwings])
