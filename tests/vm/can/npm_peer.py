# SPDX-License-Identifier: BSD-3-Clause
"""Tests our CANopen client with a node made of third-party packages (npm: canopen, socketcan). can-scan reads it, and start-up
configures its PDOs. The node is enabled over them, reports an emergency, restarts, and answers late and wrongly."""
import pathlib
import subprocess
import sys
import time
import unittest

from bench import (BUS, FAULTS, JOINT, MODES, Daemon, ctl, daemon_toml, joint_state, joint_toml, make_bus, make_key, must,
                   remove_bus, show_and_exit, wait_until)


# An interpreter cannot answer within every millisecond.
SLOW = 'zero_torque_after = 100\nquick_stop_after = 1000\n'
PATIENCE = '\n[joint.supervision]\nmissed_readings_limit = 1000\n'
PATIENT = joint_toml(can=SLOW) + PATIENCE
BY_POSITION = joint_toml(can=SLOW + 'drive_mode = "position"') + PATIENCE
PLACE = 160000


class Peer(unittest.TestCase):
    def setUp(self):
        subprocess.run(['tar', 'xmf', 'peer.tar'], check=True)
        make_bus()
        self.addCleanup(remove_bus)
        self.log = pathlib.Path('peer.log')
        self.process = None
        self.addCleanup(self.stop_peer)

    def start_peer(self, *mode):
        with open(self.log, 'w') as log:
            self.process = subprocess.Popen(['node', 'peer.js', BUS, '3', *mode], stdin=subprocess.PIPE, stdout=log,
                                            stderr=subprocess.STDOUT, text=True)
        wait_until(lambda: 'ready' in self.log.read_text(), 10, 'the peer runs')

    def stop_peer(self):
        self.process.kill()
        self.process.wait()

    def tell(self, line):
        self.process.stdin.write(line + '\n')
        self.process.stdin.flush()
        wait_until(lambda: f'told {line}' in self.log.read_text(), 5, 'the peer has heard it')

    def start_daemon(self, joint=PATIENT):
        """Ends the daemon before the bus is removed. Otherwise it would fault, and its log would mislead."""
        daemon = Daemon(daemon_toml([joint]))
        self.addCleanup(daemon.kill)
        return daemon

    def wait_for_fault(self):
        wait_until(lambda: joint_state()['mode'] == MODES['faulted'], 3, 'the joint faults')
        return joint_state()['fault']

    def enable(self):
        must('enable', JOINT)
        self.assertEqual(joint_state()['mode'], MODES['holding'])

    def test_is_found_and_configured_as_start_up_does_it_also_by_late_answers_but_not_by_wrong_ones(self):
        self.start_peer()
        status, text = ctl('can-scan', BUS, timeout_s=10)
        print(text)
        self.assertEqual(status, 0, text)
        self.assertIn('000000FB', text)
        self.assertIn('CST', text)
        status, text = self.check()
        self.assertEqual(status, 0, text)
        self.assertIn('start-up would accept every drive', text)
        # The peer has passed its own states and is pre-operational again.
        self.assertEqual([line for line in self.log.read_text().splitlines() if line.startswith('nmt')][-2:],
                         ['nmt 5', 'nmt 127'])
        self.tell('late 100')
        status, text = self.check()
        self.assertEqual(status, 0, text)
        self.tell('right')
        self.tell('wrong')
        begun = self.log.read_text().count('nmt 0')
        status, text = self.check()
        self.assertNotEqual(status, 0, text)
        self.assertIn('node 3: no answer', text)
        self.assertEqual(self.log.read_text().count('nmt 0'), begun, 'nothing was changed in it')

    def check(self):
        make_key()
        pathlib.Path('peer.toml').write_text(daemon_toml([joint_toml()]))
        return ctl('can-check', 'peer.toml', timeout_s=30)

    def test_is_held_where_it_stands_by_its_own_loop_and_stopped_by_it_at_an_emergency(self):
        self.start_peer('position')
        daemon = self.start_daemon(BY_POSITION)
        self.assertIn('mode 8 (CSP)', daemon.text())
        self.assertIn('(6065h)', daemon.text())
        self.enable()
        time.sleep(0.5)
        self.assertEqual(joint_state()['mode'], MODES['holding'], daemon.text())
        places = [int(line.split()[1]) for line in self.log.read_text().splitlines() if line.startswith('place')]
        self.assertTrue(places, 'it was sent somewhere')
        self.assertLessEqual(max(abs(place - PLACE) for place in places), 1)
        self.tell('emcy 0x2310')
        self.assertEqual(self.wait_for_fault(), FAULTS['drive fault'])
        wait_until(lambda: 'controlword 2 ' in self.log.read_text(), 2, 'a quick stop')

    def test_is_enabled_over_its_pdos_and_held_until_its_own_emergency_or_restart(self):
        self.start_peer()
        daemon = self.start_daemon()
        self.enable()
        self.assertIn('status 1237', self.log.read_text(), 'Operation enabled, and it follows (bit 12)')
        time.sleep(0.5)
        self.assertEqual(joint_state()['mode'], MODES['holding'], daemon.text())
        self.assertNotIn('were not sent', daemon.text())
        # An emergency is a fault with its error code.
        self.tell('emcy 0x2310')
        self.assertEqual(self.wait_for_fault(), FAULTS['drive fault'])
        self.assertEqual(joint_state()['drive_error'] & 0xFFFF, 0x2310, daemon.text())
        wait_until(lambda: 'status 250' in self.log.read_text().splitlines()[-1], 2, 'it was switched off')
        self.tell('emcy 0')
        must('clear-fault', JOINT)
        self.enable()
        # A restart is a fault too, and clearing it sets the peer up anew.
        self.stop_peer()
        self.wait_for_fault()
        self.start_peer()
        time.sleep(0.5)
        self.assertNotIn('controlword f', self.log.read_text(), 'it is enabled by an order only')
        must('clear-fault', JOINT)
        wait_until(lambda: 'nmt 5' in self.log.read_text(), 10, 'it is set up anew')
        time.sleep(0.5)
        self.enable()


if pathlib.Path('peer.tar').stat().st_size == 0:
    print('the peer is missing: npm could not install it')
    sys.exit(77)
show_and_exit([Peer])
