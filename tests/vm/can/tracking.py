# SPDX-License-Identifier: BSD-3-Clause
"""A joint over CAN must track as well as the simulated driver with the same delay."""
import time
import unittest

from bench import (JOINT, Daemon, Drive, Recording, daemon_toml, joint_state, joint_toml, make_bus, must, remove_bus,
                   show_and_exit, wait_until)

AMBIENT = 'constant:15'
# The staircase of docs/theory.md: it starts at 0.1 rad and rises by 0.2 rad every second, to five stairs.
STAIRS_rad = (0.1, 0.3, 0.5, 0.7, 0.9)
STAIR_S = 1.0
SIMULATED = f'''
[joint.simulated]
ambient_temperature_C = "{AMBIENT}"
temperature_noise_C = 0.0
'''


def pi2(rows):
    """Sum of |e / r| over one second of each stair, with the position that the daemon measures, and the number of stairs."""
    total, stairs = 0.0, 0
    for setpoint_rad in STAIRS_rad:
        stair = [row for row in rows if abs(float(row['target_position_rad']) - setpoint_rad) < 1e-9]
        first = int(stair[0]['cycle'])
        second = [row for row in stair if int(row['cycle']) < first + 1000 * STAIR_S]
        assert len(second) == 1000 * STAIR_S, f'{len(second)} states of stair {setpoint_rad} rad'
        total += sum(abs(float(row['joint_position_rad']) / setpoint_rad - 1.0) for row in second)
        stairs += 1
    return total, stairs


class Tracking(unittest.TestCase):
    def climb(self, name, joint):
        daemon = Daemon(daemon_toml([joint], state_rate_Hz=1000), name=name)
        daemon.hurry_gateway()
        must('enable', JOINT)
        # The daemon uses the gains of the table only after two seconds of valid temperature.
        time.sleep(2.5)
        recording = Recording(name=name)
        time.sleep(0.1)
        for setpoint_rad in STAIRS_rad:
            must('move', JOINT, str(setpoint_rad))
            time.sleep(STAIR_S + 0.05)
        rows = recording.end()
        must('disable', JOINT)
        self.assertEqual(daemon.end(), 0, daemon.text())
        return pi2(rows)

    def test_a_joint_over_can_is_as_good_as_the_simulated_one_with_the_same_delay(self):
        simulated, stairs = self.climb('simulated', joint_toml(driver='simulated', section=SIMULATED))
        make_bus()
        drive = Drive(options=['--ambient-temperature_C', AMBIENT])
        wait_until(lambda: drive.report()['nmt'] == 'pre-operational', 1, 'the drive has booted')
        over_can, _ = self.climb('can', joint_toml())
        drive.end()
        remove_bus()
        print(f'PI2 over {stairs} stairs: simulated {simulated:.3f}, over CAN {over_can:.3f}, '
              f'{100 * (over_can / simulated - 1):+.2f} %')
        self.assertAlmostEqual(over_can / simulated, 1.0, delta=0.03)


show_and_exit([Tracking])
