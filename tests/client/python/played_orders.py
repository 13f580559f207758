# SPDX-License-Identifier: BSD-3-Clause
"""A fake network, and the base of the tests of orders that a joint sends on it. Each kind of order has its own test file."""
import collections
import threading
import unittest

from strainwave import Joint, Mode, Notice, Reason, ack_v1, command_v1, messages, path_v1, setpoint_v1, state_v1
from strainwave.network import Network, now_s

COMMAND, SETPOINT, PATH = "SW.elbow.COMMAND", "SW.elbow.SETPOINT", "SW.elbow.PATH"
YIELDED = dict(notices=int(Notice.YIELDED), yield_load_Nm=-13.1042, yield_limit_Nm=12.0, yield_position_rad=0.3011)
TYPES = {COMMAND: command_v1, SETPOINT: setpoint_v1, PATH: path_v1}


class PlayedNetwork:
    """The parts of Network that a joint needs. `daemon` receives each published message and may answer at once."""

    url = "udpm://played"
    listen, wait_until = Network.listen, Network.wait_until

    def __init__(self):
        self.changed = threading.Condition(threading.RLock())
        self.joints = {}
        self.read_wholly = collections.Counter()
        self._handlers = {}
        self.published = []
        self.came_s = now_s()
        self.daemon = lambda channel, message: None

    def publish(self, channel, message):
        self.published.append((channel, message))
        self.daemon(channel, message)

    def deliver(self, kind, message, joint="elbow", age_s=0.0, prefix="SW"):
        with self.changed:
            self.came_s = now_s() - age_s
            for handler in self._handlers[f"{prefix}.{joint}.{kind}".encode()]:
                handler()(message.encode())
            self.changed.notify_all()


def published(channel, message):
    return messages.decode_exactly(TYPES[channel], message)


class PlayedOrders(unittest.TestCase):
    def setUp(self):
        self.network = PlayedNetwork()
        shared = Network.shared
        self.addCleanup(setattr, Network, "shared", shared)
        Network.shared = lambda url=None: self.network
        self.elbow = Joint("elbow", key="", timeout_s=30)
        self.impatient_elbow = Joint("elbow", key="", timeout_s=0.2)
        self.state = messages.blank(state_v1)
        self.state.session_id, self.state.challenge = 11, 22

    def publish_state(self, mode=Mode.HOLDING, *, joint="elbow", **fields):
        self.state.mode = int(mode)
        for name, value in fields.items():
            setattr(self.state, name, value)
        self.network.deliver("STATE", self.state, joint)

    def answer(self, order, accepted=1, reason=Reason.ACCEPTED, text="", **fields):
        ack = messages.blank(ack_v1)
        ack.sender_id, ack.sequence, ack.accepted, ack.reason = order.sender_id, order.sequence, accepted, int(reason)
        ack.text = text.encode().ljust(232, b"\0")
        for name, value in fields.items():
            setattr(ack, name, value)
        self.network.deliver("ACK", ack)

    def orders(self):
        return [published(*entry) for entry in self.network.published]
