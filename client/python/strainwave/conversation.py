# SPDX-License-Identifier: BSD-3-Clause
"""A conversation with one joint of a daemon: receives its state, sends an order, repeats it until it is acknowledged.
Source: client/protocol/client.h, pending_order.h; docs/commands.md.
"""
import collections
import math

from .ack_v1 import ack_v1
from .errors import InvalidInput, NoAnswer, NotDone, Refused
from .limits_v1 import limits_v1
from .messages import decode_exactly, text_of
from .network import now_s
from .state_v1 import state_v1
from .vocabulary import Reason

ATTEMPTS = 3  # with a higher sequence each, when another program with the same key was ahead
TRANSMISSIONS = 4  # of an unanswered message per lifetime of an order, if it fits into one packet
STOP_TRANSMISSIONS = 8  # of a stop
STOP_PATIENCE_S = 4.0  # at least; longer than the daemon needs to replace a hung gateway
_PACKET_BYTES = 1472  # Ethernet's 1500 less the headers of IP and UDP
_INBOX = 4096
_CLOCK_STATES = 64
_GONE_S = 2.5  # a joint with an older last state counts as gone
_SILENCE_S = 0.5  # states come at least ten times a second
_OLD_STATE_S = 0.5  # well below the second after which the daemon refuses an order that quotes the state
_LARGEST_CYCLE = 2**62  # above any real cycle; leaves room in a message for later arithmetic
_PERIODS_S = (1e-6, 1.0)  # wider than the range of any daemon
_ORDER_LIFETIME_S = 1.0  # from the call to the state that the order quotes
_SETTLES_S = 0.2  # after a stop or a fault, one of the next two states has a new challenge


def most_transmissions(message_bytes, timeout_s):
    """Number of transmissions of a message of this size. The daemon refuses repetitions older than an order's lifetime, so each lifetime has its
    own. Each Ethernet packet adds one, because the loss of any packet loses the message."""
    packets = max(1, -(-message_bytes // _PACKET_BYTES))
    return (TRANSMISSIONS + packets - 1) * max(1, math.ceil(timeout_s / _ORDER_LIFETIME_S))


class CycleClock:
    """Estimates the daemon's current cycle from received states. The state with the shortest travel time gives the estimate."""

    def __init__(self):
        self._heard = collections.deque(maxlen=_CLOCK_STATES)

    def restart(self):
        self._heard.clear()

    def take(self, cycle, received_s):
        self._heard.append((cycle, received_s))

    def cycle_at(self, time_s, period_s):
        """The cycle at `time_s` as a real number. At least one state must have been received."""
        return max(cycle + (time_s - received_s) / period_s for cycle, received_s in self._heard)


class Conversation:
    """The messages of one joint, and orders to it. Every wait ends after `timeout_s`."""

    def __init__(self, network, prefix, joint, sender, timeout_s):
        self.network, self.prefix, self.joint, self.sender, self.timeout_s = network, prefix, joint, sender, timeout_s
        self.state = None  # the latest state_v1
        self.received_s = 0.0
        self.is_behind = False  # the program was stalled: the latest state waited for a while, and newer ones follow
        self._misunderstood = False  # whether the last state could not be decoded
        self.messages = 0
        self.limits = None  # the latest limits_v1
        self.clock = CycleClock()
        self._stopped = 0  # number of states received when the last stop was answered
        self._fault_challenge = None  # of the first state with the last fault
        self._inboxes = []
        self._awaited = {}  # acknowledgements by sequence; None: not received yet
        self._sent = collections.deque(maxlen=256)  # sequences of the latest messages of send()
        self._refusals = collections.deque(maxlen=16)
        for kind, method in (("STATE", self._on_state), ("LIMITS", self._on_limits), ("ACK", self._on_ack)):
            network.listen(self.channel(kind), method)

    def channel(self, kind):
        return f"{self.prefix}.{self.joint}.{kind}"

    def require_same_daemon(self, other, who):
        """Raises InvalidInput unless both joints belong to the same daemon, because each daemon counts its own cycles."""
        if self.prefix != other.prefix:
            raise InvalidInput(f"{self.joint} has prefix {self.prefix}, {other.joint} has {other.prefix}: {who} must belong to one daemon")
        if self.network.url != other.network.url:
            raise InvalidInput(f"{self.joint} is on {self.network.url}, {other.joint} on {other.network.url}: {who} must belong to one daemon")

    def wait_for_state(self):
        """The latest state; waits for the first. Raises NoAnswer that lists the joints heard instead."""
        if not self.network.wait_until(lambda: self.state is not None, self.timeout_s):
            raise NoAnswer(self._silence())
        return self.state

    def heard_state(self):
        """The latest state, as wait_for_state(). Raises NoAnswer also when none came for longer than `timeout_s`. If this program
        was stalled, it first takes the states that arrived in the meantime."""
        self.wait_for_state()
        seen = self.messages
        if now_s() - self.received_s > self.timeout_s and not self.network.wait_until(lambda: self.messages > seen, _OLD_STATE_S):
            raise NoAnswer(f"{self.joint}: no state for {now_s() - self.received_s:.1f} s; is strainwaved running?")
        return self.state

    def open_inbox(self):
        """A queue that gets every state from now on, with its time of receipt. If it is full, the oldest are lost."""
        inbox = collections.deque(maxlen=_INBOX)
        with self.network.changed:
            self._inboxes.append(inbox)
            self.network.read_wholly[self.channel("STATE").encode()] += 1
        return inbox

    def close_inbox(self, inbox):
        with self.network.changed:
            self._inboxes = [other for other in self._inboxes if other is not inbox]
            self.network.read_wholly[self.channel("STATE").encode()] -= 1

    def deciding_state(self):
        """The state on which a new order is based. The order and its repetitions quote it. The daemon refuses the order if the state is over
        a second old, or if the joint stopped or faulted since. So this waits until the state is newer than a stop or a fault. Raises NoAnswer
        as wait_for_state(), and NotDone if this program was stalled meanwhile, because the caller has not seen the events of that time.
        """
        begin_s, patience_s = now_s(), _ORDER_LIFETIME_S + (self.timeout_s if self.state is None else 0)
        self.wait_for_state()
        self.network.wait_until(lambda: self.messages > self._stopped and self.state.challenge != self._fault_challenge, _SETTLES_S)
        state, stood_s = self.state, now_s() - begin_s
        if stood_s > patience_s:
            raise NotDone(f"{self.joint}: this program stood still for {stood_s:.1f} s after the call, and the order was not sent: see what the "
                          "joint does, then give it again")
        return state

    def request(self, kind, message, order, prepare=None, hint="", state=None):
        """Sends an order and requires its acceptance. `order`: in words; `prepare`: called with the message before every attempt.
        `hint`: added to the error for a value out of range; `state`: its deciding_state(), None: the present one. Raises Refused, NoAnswer.
        """
        state = self.deciding_state() if state is None else state
        for attempt in range(ATTEMPTS):
            if prepare:
                prepare(message)
            transmissions = most_transmissions(len(message.encode()), self.timeout_s)
            answer = self._exchange(kind, message, state, transmissions, self.timeout_s)
            if answer is None:
                raise NoAnswer(f"{self.joint}: no acknowledgement of {order} in {self.timeout_s:g} s, after "
                               f"{transmissions} transmissions: {self._why_no_answer()} Whether the command was carried "
                               "out is not known: see Joint.state")
            if answer.accepted == 1:
                return
            if attempt + 1 == ATTEMPTS or answer.reason != Reason.OLD_SEQUENCE:
                break
            self.sender.rise_above(answer.last_sequence)
        reason = Reason(answer.reason)
        raise Refused(self.joint, order, reason, text_of(answer.text), hint if reason == Reason.OUT_OF_RANGE else "")

    def request_stop(self, kind, message, order):
        """The same for a stop: it does not wait for a state. If no answer comes, the error says that the stop was sent."""
        transmissions = STOP_TRANSMISSIONS * max(1, math.ceil(self.timeout_s / STOP_PATIENCE_S))
        answer = self._exchange(kind, message, self.state, transmissions, max(self.timeout_s, STOP_PATIENCE_S))
        self._stopped = self.messages
        if answer is None:
            raise NoAnswer(f"{self.joint}: the stop was sent {transmissions} times, and no answer came: "
                           + (self._why_no_answer() if self.state else self._silence()))
        if answer.accepted != 1:
            raise Refused(self.joint, order, Reason(answer.reason), text_of(answer.text))

    def send(self, kind, message):
        """Sends a message of a stream once. take_refusal() returns its refusal, if any. Raises NoAnswer if the joint has become silent."""
        state = self.heard_state()
        channel = self.channel(kind)
        encoded = self.sender.seal(channel, message, state)
        with self.network.changed:
            self._sent.append(message.sequence)
        self.network.publish(channel, encoded)

    @property
    def has_refusals(self):
        return bool(self._refusals)

    def take_refusal(self):
        """(Reason, text, overtaken) of the oldest refusal of a message of send() that was not yet taken, or None. Overtaken: a later
        message of send() arrived at the daemon first."""
        with self.network.changed:
            if not self._refusals:
                return None
            ack = self._refusals.popleft()
            overtaken = ack.reason == Reason.OLD_SEQUENCE and ack.last_sequence in self._sent
        return Reason(ack.reason), text_of(ack.text), overtaken

    def forget_sent(self):
        """From now on ignores answers to earlier messages of send()."""
        with self.network.changed:
            self._sent.clear()
            self._refusals.clear()

    def _exchange(self, kind, message, state, transmissions, timeout_s):
        channel = self.channel(kind)
        encoded = self.sender.seal(channel, message, state)
        sequence = message.sequence
        with self.network.changed:
            self._awaited[sequence] = None
        try:
            for _ in range(transmissions):
                self.network.publish(channel, encoded)
                if self.network.wait_until(lambda: self._awaited[sequence] is not None, timeout_s / transmissions):
                    break
            return self._awaited[sequence]
        finally:
            with self.network.changed:
                del self._awaited[sequence]

    def _on_state(self, content):
        message = decode_exactly(state_v1, content)
        self._misunderstood = message is None
        if message is None or not 0 <= message.cycle <= _LARGEST_CYCLE:
            return
        if self.state is not None and self.state.session_id != message.session_id:
            self.clock.restart()
            self.limits = None
        if self.state is not None and message.fault != 0 and self.state.fault == 0:
            self._fault_challenge = message.challenge
        self.state, self.received_s = message, now_s()
        self.is_behind = self.received_s - self.network.came_s > _OLD_STATE_S
        self.messages += 1
        self.clock.take(message.cycle, self.network.came_s)
        for inbox in self._inboxes:
            inbox.append((message, self.received_s))

    def _on_limits(self, content):
        limits = decode_exactly(limits_v1, content)
        if limits is not None and _PERIODS_S[0] <= limits.period_s <= _PERIODS_S[1]:
            self.limits = limits

    def _on_ack(self, content):
        ack = decode_exactly(ack_v1, content)
        if ack is None or ack.sender_id != self.sender.sender_id:
            return
        if ack.sequence in self._awaited:
            self._awaited[ack.sequence] = self._awaited[ack.sequence] or ack
        elif ack.accepted != 1 and ack.sequence in self._sent:
            self._refusals.append(ack)

    def silence(self):
        """"no state for 3.2 s" after half a second without a state, or after the time-out if that is less; otherwise empty."""
        silent_s = now_s() - self.received_s
        return f"no state for {silent_s:.1f} s" if silent_s >= min(_SILENCE_S, self.timeout_s) else ""

    def fell_silent(self, what):
        """The NoAnswer for a joint that has become silent. `what` describes the failure in words."""
        return NoAnswer(": ".join(part for part in (self.joint, what, self.silence()) if part))

    def _why_no_answer(self):
        silence = self.silence()
        return f"{silence}; is strainwaved running?" if silence else "the daemon publishes its state but does not answer; see its log."

    def _silence(self):
        now = now_s()
        heard = sorted(joint for joint, came_s in self.network.joints.items() if now - came_s <= max(self.timeout_s, _GONE_S))
        joints = [joint for prefix, joint in heard if prefix == self.prefix]
        if self._misunderstood:
            return (f"the daemon on prefix {self.prefix} has another version than this program: its states have another type "
                    "than state_v1. Install the same version of both")
        if self.joint in joints:
            silent_s = now - self.network.joints[self.prefix, self.joint]
            return f"{self.joint}: no state came in {self.timeout_s:g} s; the last one came {silent_s:.2f} s ago"
        if joints:
            return f"no joint '{self.joint}' on prefix {self.prefix}; its joints are: {', '.join(joints)}"
        words = f"no daemon on prefix {self.prefix} in {self.timeout_s:g} s ({self.network.url})."
        prefixes = sorted({prefix for prefix, _ in heard})
        if prefixes:
            return f"{words} Daemons are heard on: {', '.join(prefixes)} (choose one with prefix=)"
        return f"{words} Is strainwaved running, and are its lcm_url and prefix the same as here?"
