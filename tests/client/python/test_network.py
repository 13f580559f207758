# SPDX-License-Identifier: BSD-3-Clause
"""Tests over real multicast, in scripts/private-network: arbitrary datagrams, a daemon that requires signatures, and the choice of the group."""
import os
import pathlib
import random
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

from strainwave import InvalidInput, Joint, Mode, NoAnswer, Reason, Refused, messages, state_v1
from strainwave.lcm_wire import encode_short
from strainwave.network import Network, parse_url

GROUP = "239.255.76.67"
SOURCE = pathlib.Path(os.environ["STRAINWAVE_SOURCE_DIR"])
PROGRAMS = pathlib.Path(os.environ["STRAINWAVE_PROGRAMS"])


class HostileDatagrams(unittest.TestCase):
    PORT = 20000 + os.getpid() % 20000

    def setUp(self):
        self.elbow = Joint("elbow", key="", lcm_url=f"udpm://{GROUP}:{self.PORT}?ttl=0", timeout_s=20)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)

    def send(self, datagram):
        self.socket.sendto(datagram, (GROUP, self.PORT))

    def test_do_not_keep_a_state_from_being_heard(self):
        state = messages.blank(state_v1)
        state.joint_position_rad = 0.25
        chance = random.Random(5)
        good = encode_short(1, "SW.elbow.STATE", state.encode())
        self.send(b"")
        for _ in range(300):
            broken = bytearray(good)
            for _ in range(3):
                broken[chance.randrange(40)] = chance.randrange(256)
            self.send(bytes(broken[:chance.randrange(len(broken))]))
            self.send(chance.randbytes(chance.randrange(1400)))
        for kind in ("STATE", "ACK", "LIMITS"):
            self.send(encode_short(2, f"SW.elbow.{kind}", b"\xff" * messages.size_of(state_v1)))
        state.session_id = 9  # differs from any state that the noise may contain
        for _ in range(3):
            self.send(encode_short(3, "SW.elbow.STATE", state.encode()))
        self.elbow._wait_until(lambda: self.elbow._conversation.state and self.elbow._conversation.state.session_id == 9, 20)
        self.assertEqual((self.elbow.state.joint_position_rad, self.elbow.state.session_id), (0.25, 9))

    def test_that_a_program_took_up_late_are_as_old_as_they_are(self):
        network = Network.shared(self.elbow._conversation.network.url)
        heard = []

        class Listener:
            def hear(self, content):
                if bytes(content) == b"x":
                    heard.append(network.came_s)

        listener = Listener()
        network.listen("SW.elbow.ACK", listener.hear)
        sent_s = []
        with network.changed:  # blocks the handling of messages
            for i in range(4):
                sent_s.append(time.monotonic())
                self.send(encode_short(i, "SW.elbow.ACK", b"x"))
                time.sleep(0.2)
        network.wait_until(lambda: len(heard) == 4, 20)
        for came_s, sent in zip(heard, sent_s, strict=True):
            self.assertTrue(-0.01 <= came_s - sent <= 0.1, (heard, sent_s))

    def test_from_another_machine_are_not_heard_where_the_network_ends_at_this_one(self):
        network = Network.shared(self.elbow._conversation.network.url)
        datagram = encode_short(1, "SW.stranger.STATE", messages.blank(state_v1).encode())
        network.accept(("192.0.2.1", 7), datagram)
        self.assertNotIn(("SW", "stranger"), network.joints)
        network.accept(("127.0.0.1", 7), datagram)
        self.assertIn(("SW", "stranger"), network.joints)


class ADaemonThatPublishesFasterThanTheyAreHandled(unittest.TestCase):
    URL = f"udpm://{GROUP}:{20001 + os.getpid() % 20000}?ttl=0"
    PUBLISH = """
import sys, time
from strainwave import messages, state_v1
from strainwave.network import Network
network, state = Network(sys.argv[1]), messages.blank(state_v1)
while True:
    state.utime, state.cycle = time.time_ns() // 1000, state.cycle + 1
    network.publish("SW.elbow.STATE", state.encode())
    time.sleep(1e-3)
"""

    class SlowMachine:
        def hear(self, content):
            time.sleep(5e-3)

    def setUp(self):
        self.elbow = Joint("elbow", key="", lcm_url=self.URL, timeout_s=20)
        self.slow = self.SlowMachine()
        Network.shared(self.URL).listen("SW.elbow.STATE", self.slow.hear)
        daemon = subprocess.Popen([sys.executable, "-c", self.PUBLISH, self.URL])
        self.addCleanup(daemon.wait)
        self.addCleanup(daemon.kill)

    def test_is_heard_by_its_newest_states(self):
        self.assertIsNotNone(self.elbow.state)
        time.sleep(2)
        ages_s = []
        for _ in range(20):
            time.sleep(0.02)
            ages_s.append(time.time() - 1e-6 * self.elbow.state.utime)
        self.assertLess(min(ages_s), 0.2, ages_s)  # the daemon refuses an order that quotes a state of a second ago

    def test_is_heard_wholly_by_who_asks_for_every_state(self):
        self.assertIsNotNone(self.elbow.state)
        cycles = [state.cycle for state in self.elbow.states(0.5)]
        steps = [later - earlier for earlier, later in zip(cycles, cycles[1:])]
        self.assertEqual(statistics.median(steps), 1, cycles)  # the system's queue may overflow and lose some states


class AnAdapterThatComesBack(unittest.TestCase):
    NEW = ("link add lan0 type bridge", "address add 192.168.7.1/24 dev lan0", "link set lan0 up multicast on", "route add 239.255.76.68/32 dev lan0")

    def ip(self, *commands):
        for command in commands:
            subprocess.run(["ip", *command.split()], check=True, env={"PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"})

    def test_is_joined_anew(self):
        self.ip(*self.NEW)
        self.addCleanup(self.ip, "link delete lan0")
        network = Network("udpm://239.255.76.68:7667?ttl=0")

        def hears_itself():
            network.joints.clear()
            for _ in range(100):
                network.publish("SW.elbow.STATE", b"")
                if network.wait_until(lambda: network.joints, 0.1):
                    return True
            return False

        self.assertTrue(hears_itself())
        for _ in range(2):
            self.ip("link delete lan0", *self.NEW)
            with self.assertLogs("strainwave", "WARNING") as logs:
                self.assertTrue(hears_itself())
            self.assertIn("joined the group there anew", logs.output[0])


class ADaemonThatWantsSignatures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.key = self.folder / "key"
        self.control("keygen", "--out", self.key, "--role", "operator")
        (self.folder / "authorized_keys").write_text((self.folder / "key.pub").read_text())
        (self.folder / "authorized_keys").chmod(0o600)
        text = (SOURCE / "config/demo.toml").read_text()
        text = text.replace('unsigned_orders = "allow"', 'authorized_keys = "authorized_keys"')
        text = text.replace('driver = "simulated"', f'driver = "simulated"\ntable = "{SOURCE}/data/tables/rhs17-6006.json"')
        (self.folder / "daemon.toml").write_text(text)
        with open(self.folder / "log", "w") as log:
            self.daemon = subprocess.Popen([PROGRAMS / "strainwaved", "--config", self.folder / "daemon.toml"], cwd=self.folder,
                                           stdout=log, stderr=log)
        self.addCleanup(self.end)
        deadline = time.monotonic() + 60
        while "ready" not in (self.folder / "log").read_text():
            self.assertIsNone(self.daemon.poll(), (self.folder / "log").read_text())
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

    def end(self):
        self.daemon.terminate()
        self.daemon.wait(60)

    def control(self, *words):
        return subprocess.run([PROGRAMS / "strainwavectl", *words], check=True, capture_output=True, text=True)

    def test_obeys_a_key_and_stops_without(self):
        signing, unsigned = Joint("elbow", key=self.key, timeout_s=20), Joint("elbow", key="", timeout_s=20)
        with self.assertRaises(Refused) as caught:
            unsigned.enable()
        self.assertIs(caught.exception.reason, Reason.UNSIGNED)
        # The program uses the same key as strainwavectl, so it may move the joint that strainwavectl has enabled.
        self.control("--key", self.key, "--timeout_s", "20", "enable", "elbow")
        arrival = signing.move(0.3)
        self.assertLessEqual(abs(arrival.error_rad), 1e-3)
        with signing.stream() as stream:
            for i in range(30):
                stream.put(i / 50, 0.3)
        self.assertEqual(signing.state.mode, Mode.HOLDING)
        unsigned.disable()
        self.assertEqual(signing.state.mode, Mode.OFF)
        unsigned.clear_fault()

    def test_that_is_gone_is_told_from_one_that_refuses(self):
        elbow = Joint("elbow", key=self.key, timeout_s=20)
        elbow.enable()
        elbow._conversation.timeout_s = 0.5
        self.daemon.kill()
        self.daemon.wait(60)
        with self.assertRaisesRegex(NoAnswer, "the stop was sent 8 times, and no answer came"):
            elbow.disable()


class Urls(unittest.TestCase):
    def test_are_read_as_lcm_does(self):
        self.assertEqual(parse_url("udpm://239.1.2.3:99?ttl=1"), ("239.1.2.3", 99, 1))
        self.assertEqual(parse_url("udpm://"), ("239.255.76.67", 7667, 0))

    def test_that_are_none_are_refused(self):
        for url in ("", "tcpq://1.2.3.4:5", "udpm://10.0.0.1:7667", "udpm://239.255.76.67:0", "udpm://239.255.76.67:99999",
                    "udpm://239.255.76.67:x", "udpm://host:7667", "udpm://239.255.76.67?ttl=x", 5):
            with self.assertRaisesRegex(InvalidInput, "lcm_url = "):
                parse_url(url)


if __name__ == "__main__":
    unittest.main()
