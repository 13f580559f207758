# SPDX-License-Identifier: BSD-3-Clause
"""One joint: start-up, staircase, shut-down. The frames at start-up must match the golden file."""
import difflib
import pathlib
import subprocess
import time
import unittest

from bench import (BUS, JOINT, MODES, Daemon, Drive, ctl, daemon_toml, joint_state, joint_toml, make_bus, must,
                   show_and_exit, wait_until)


class BringUp(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        make_bus()

    def test_a_joint_is_brought_up_follows_the_staircase_and_is_shut_down(self):
        drive = Drive()
        time.sleep(0.2)
        with open('dump', 'w') as dump:
            watcher = subprocess.Popen(['candump', BUS], stdout=dump)
            time.sleep(0.1)
            daemon = Daemon(daemon_toml([joint_toml()]))
            watcher.terminate()
            watcher.wait()
        self.check_start_up(pathlib.Path('dump').read_text().splitlines())
        self.assertEqual(drive.report()['nmt'], 'operational')

        must('enable', JOINT)
        self.assertEqual(joint_state()['mode'], MODES['holding'])
        self.assertIsNotNone(drive.find('power OperationEnabled'))
        for setpoint_rad in (0.01, 0.03, 0.1, 0.3, 1.0):
            must('move', JOINT, str(setpoint_rad), '--wait')
            self.assertAlmostEqual(float(drive.report()['position_rad']), setpoint_rad, delta=2e-4)

        must('disable', JOINT)
        self.assertEqual(joint_state()['mode'], MODES['off'])
        wait_until(lambda: drive.report()['power'] != 'OperationEnabled', 1, 'the drive is disabled')
        self.assertEqual(float(drive.report()['torque_Nm']), 0.0)
        self.assertEqual(daemon.end(), 0, daemon.text())
        # The orderly end of the daemon must not look like a lost master.
        time.sleep(0.5)
        self.assertIsNone(drive.find('heartbeat-lost'))
        self.assertIsNone(drive.find('emcy'))
        drive.end()

    def test_a_joint_whose_drive_closes_its_own_loop_arrives(self):
        for drive_mode, modes in (('position', 'csp'), ('position', 'ip'), ('velocity', 'csv')):
            with self.subTest(modes):
                drive = Drive(options=['--modes', modes, '--initial-position_rad', '0.2'])
                wait_until(lambda: drive.report()['nmt'] == 'pre-operational', 1, 'the drive has booted')
                # The unit of 60FFh and 60B1h is counts a second.
                daemon = Daemon(daemon_toml([joint_toml(
                    can=f'drive_mode = "{drive_mode}"\nvelocity_rad_s_per_unit = 1.9634954e-5')]), name=modes)
                must('enable', JOINT)
                self.assertAlmostEqual(float(drive.report()['position_rad']), 0.2, delta=2e-4)
                for setpoint_rad in (0.1, 0.3, 1.0):
                    must('move', JOINT, str(setpoint_rad), '--wait')
                    time.sleep(0.5)
                    self.assertAlmostEqual(float(drive.report()['position_rad']), setpoint_rad, delta=2e-4)
                must('disable', JOINT)
                self.assertEqual(daemon.end(), 0, daemon.text())
                self.assertIn('stability is not proved', daemon.text())
                drive.end()

    def check_start_up(self, lines):
        """Compares the frames up to the start of the network. Leaves out heartbeats, because their instants vary."""
        frames = [' '.join(line.split()[1:]) for line in lines]
        frames = [frame for frame in frames if not (frame.startswith('7') and not frame.endswith('[1] 00'))]
        # How often 6061h is polled until it follows 6060h depends on the drive alone, so only the last poll is compared.
        asked = [i for i, frame in enumerate(frames) if frame.startswith('603 [8] 40 61 60 00')]
        for i in reversed(asked[:-1]):
            del frames[i:i + 2]
        start = next(i for i, frame in enumerate(frames) if frame == '000 [2] 01 03')
        seen = frames[:start + 1]
        golden = [line for line in pathlib.Path('startup.candump').read_text().splitlines() if not line.startswith('#')]
        pathlib.Path('/vmout/startup.candump').write_text('\n'.join(seen) + '\n')
        self.assertEqual(seen, golden, '\n'.join(difflib.unified_diff(golden, seen, 'golden', 'seen', lineterm='')))


show_and_exit([BringUp])
