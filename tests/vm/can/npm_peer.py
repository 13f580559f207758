"""Our CANopen client against a node made of packages written by others (npm: canopen, socketcan): can-scan reads it, start-up
configures its PDOs, and it is enabled over them."""
import pathlib
import subprocess
import sys
import unittest

from bench import (BUS, JOINT, MODES, Daemon, ctl, daemon_toml, joint_state, joint_toml, make_bus, make_key, must,
                   remove_bus, show_and_exit, wait_until)


class Peer(unittest.TestCase):
    def setUp(self):
        subprocess.run(['tar', 'xf', 'peer.tar'], check=True)
        make_bus()
        self.log = pathlib.Path('peer.log')
        with open(self.log, 'w') as log:
            self.process = subprocess.Popen(['node', 'peer.js', BUS, '3'], stdin=subprocess.PIPE, stdout=log,
                                            stderr=subprocess.STDOUT, text=True)
        wait_until(lambda: 'ready' in self.log.read_text(), 10, 'the peer runs')

    def tearDown(self):
        self.process.kill()
        self.process.wait()
        remove_bus()

    def test_is_found_and_read(self):
        status, text = ctl('can-scan', BUS, timeout_s=10)
        print(text)
        self.assertEqual(status, 0, text)
        self.assertIn('000000FB', text)
        self.assertIn('CST', text)

    def test_is_configured_as_start_up_does_it(self):
        make_key()
        pathlib.Path('peer.toml').write_text(daemon_toml([joint_toml()]))
        status, text = ctl('can-check', 'peer.toml', timeout_s=10)
        self.assertEqual(status, 0, text)
        self.assertIn('start-up would accept every drive', text)
        # It went through the peer's own states, and came back.
        self.assertEqual([line for line in self.log.read_text().splitlines() if line.startswith('nmt')][-2:],
                         ['nmt 5', 'nmt 127'])

    def test_is_enabled_over_its_pdos(self):
        # An interpreter does not answer every millisecond.
        patient = joint_toml(can='zero_torque_after = 100\nquick_stop_after = 1000')
        daemon = Daemon(daemon_toml([patient + '\n[joint.supervision]\nmissed_readings_limit = 1000\n']))
        must('enable', JOINT)
        self.assertEqual(joint_state()['mode'], MODES['holding'])
        self.assertIn('status 1237', self.log.read_text(), 'Operation enabled, and it follows (bit 12)')
        daemon.kill()


if pathlib.Path('peer.tar').stat().st_size == 0:
    print('the peer is missing: npm could not install it')
    sys.exit(77)
show_and_exit([Peer])
