# SPDX-License-Identifier: BSD-3-Clause
"""Three joints on one bus of 1 Mbit/s move on and on without a missed frame."""
import time
import unittest

from bench import Daemon, Drive, Recording, daemon_toml, joint_toml, make_bus, must, remove_bus, show_and_exit, wait_until


class Endurance(unittest.TestCase):
    def test_three_joints_on_one_bus_miss_no_frame(self):
        nodes = {'shoulder': 1, 'elbow': 2, 'wrist': 3}
        duration_s = 4
        make_bus()
        drives = {name: Drive(node) for name, node in nodes.items()}
        for drive in drives.values():
            wait_until(lambda: drive.report()['nmt'] == 'pre-operational', 1, 'the drive has booted')
        daemon = Daemon(daemon_toml([joint_toml(name, node) for name, node in nodes.items()], state_rate_Hz=50),
                        wait_for=next(iter(nodes)))
        self.assertRegex(daemon.text(), r'vcan0: \d+\.\d % of 1000000 bit/s')
        recording = Recording(*nodes, name='endurance')
        for name, drive in drives.items():
            must('enable', name)
            drive.tell('clear')
        begin_s = time.monotonic()
        goal_rad = 1.0
        while time.monotonic() - begin_s < duration_s:
            for name in nodes:
                must('move', name, str(goal_rad))
            goal_rad = -goal_rad
            time.sleep(2.0)
        for drive in drives.values():
            report = drive.report()
            self.assertGreaterEqual(int(report['syncs']), 1000 * duration_s)
            self.assertLess(int(report['longest_sync_gap_us']), 1200, 'SYNC came every period')
            self.assertEqual(int(report['syncs_without_rpdo']), 0)
            self.assertEqual(int(report['superseded']), 0)
            self.assertIsNone(drive.find('heartbeat-lost'))
            self.assertIsNone(drive.find('emcy'))
        rows = recording.end()
        self.assertGreater(len(rows), len(nodes) * 50 * duration_s * 0.98)
        reading_missed = 1 << 4  # a notice: no fresh position in this period
        self.assertEqual([row for row in rows if int(row['notices']) & reading_missed or int(row['fault'])], [])
        for name in nodes:
            must('disable', name)
        self.assertEqual(daemon.end(), 0, daemon.text())
        for drive in drives.values():
            drive.end()
        remove_bus()


show_and_exit([Endurance])
