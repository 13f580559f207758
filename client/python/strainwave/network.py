# SPDX-License-Identifier: BSD-3-Clause
"""The LCM network: a socket that receives from the group, one that sends, and a thread that passes messages to the listeners.

The thread ends with the program. It runs the handlers, one message at a time, while it holds `changed`. Use wait_until() to wait.
"""
import collections
import logging
import os
import re
import select
import socket
import struct
import threading
import time
import urllib.parse
import weakref

from .errors import InvalidInput, NoAnswer, shown
from .lcm_wire import Reassembly, encode_short

_log = logging.getLogger("strainwave")

DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
MAX_NAMES = 1024  # more joints than any real network has
_QUEUE_BYTES = 1 << 20
_LOOK_EVERY_S = 0.5
_LARGEST_DATAGRAM = 65536
_LONGEST_WAIT_S = 1e9  # near the longest wait that the system supports
_AT_ONCE = 128  # datagrams that are read before any is handled
_SO_TIMESTAMPNS = 35  # number in Linux
_NOTE_BYTES = socket.CMSG_SPACE(16)
_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_-]{0,23}")
_STATE_CHANNEL = re.compile(rb"([A-Za-z0-9_][A-Za-z0-9_-]{0,23})\.([A-Za-z0-9_][A-Za-z0-9_-]{0,23})\.STATE")


def check_name(what, name):
    """Returns `name` if it is valid for a joint or a prefix."""
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise InvalidInput(f"{what} = {shown(name)}: 1 to 24 characters of A-Z a-z 0-9 _ - are allowed, not - first")
    return name


def parse_url(url):
    """Group, port and ttl of udpm://GROUP:PORT?ttl=N. Missing parts have the defaults of LCM."""
    wrong = InvalidInput(f"lcm_url = {shown(url)}: udpm://GROUP:PORT?ttl=N is allowed, with a group of 224.0.0.0 to 239.255.255.255, a port "
                         f"of 1 to 65535 and a ttl of 0 to 255; the usual one is {DEFAULT_URL}")
    try:
        parts = urllib.parse.urlsplit(url)
        group = parts.hostname or "239.255.76.67"
        port = 7667 if parts.port is None else parts.port
        ttl = int(urllib.parse.parse_qs(parts.query).get("ttl", ["0"])[-1])
        first = socket.inet_aton(group)[0]
    except (ValueError, TypeError, AttributeError, OSError):
        raise wrong from None
    if parts.scheme != "udpm" or group.count(".") != 3 or not 224 <= first <= 239 or not 1 <= port or not 0 <= ttl <= 255:
        raise wrong
    return group, port, ttl


class Network:
    """The network of one LCM URL. shared() returns the program's only object for a URL, whose users share its thread."""

    _shared = {}
    _shared_lock = threading.Lock()

    @classmethod
    def shared(cls, url=None):
        if url is None:
            url = os.environ.get("LCM_DEFAULT_URL") or DEFAULT_URL
        parse_url(url)
        with cls._shared_lock:
            if url not in cls._shared:
                cls._shared[url] = cls(url)
            return cls._shared[url]

    def __init__(self, url):
        self.url = url
        self.changed = threading.Condition(threading.RLock())
        self.joints = {}  # time of the last state by (prefix, joint)
        self.came_s = now_s()  # time at which the present message reached this machine
        self._caught_up_s = now_s()
        self.read_wholly = collections.Counter()  # state channels of which a listener needs every message
        self._handlers = {}
        self._reassembly = Reassembly()
        self._group, self._port, self._ttl = parse_url(url)
        self._sequence = 0
        self._membership = struct.pack("=4s4s", socket.inet_aton(self._group), socket.inet_aton("0.0.0.0"))
        try:
            self._sender, self._own_address = self._open_sender()
            self._receiver = self._open_receiver()
        except OSError as error:
            raise NoAnswer(f"LCM is not available on '{url}': {error}. To keep LCM on this PC, run as root:\n"
                           f"  ip link set lo up multicast on\n  ip route add {self._group}/32 dev lo src 127.0.0.1") from None
        threading.Thread(target=self._run, name="strainwave", daemon=True).start()

    def _open_sender(self):
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, self._ttl)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
        sender.connect((self._group, self._port))
        return sender, sender.getsockname()[0]

    def _open_receiver(self):
        receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _QUEUE_BYTES)
        # Bound to the group, not to any address, so that the kernel drops unicast.
        receiver.bind((self._group, self._port))
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, self._membership)
        receiver.setsockopt(socket.SOL_SOCKET, _SO_TIMESTAMPNS, 1)
        receiver.setblocking(False)
        return receiver

    def listen(self, channel, method):
        """Calls method(message as bytes) for each message on `channel` while its object lives. The method must be quick and not raise."""
        with self.changed:
            name = channel.encode("ascii")
            living = [handler for handler in self._handlers.get(name, ()) if handler() is not None]
            self._handlers[name] = [*living, weakref.WeakMethod(method)]

    def publish(self, channel, message):
        with self.changed:
            self._sequence += 1
            datagram = encode_short(self._sequence, channel, message)
        try:
            self._sender.send(datagram)
        except OSError as error:
            raise NoAnswer(f"LCM could not send a message on {channel} ({self.url}): {error}") from None

    def wait_until(self, condition, timeout_s):
        """Waits until condition() is true or `timeout_s` have passed; checks it after every message. Returns its last value."""
        with self.changed:
            return self.changed.wait_for(condition, min(timeout_s, _LONGEST_WAIT_S))

    def _run(self):
        looked_s = now_s()
        while True:
            select.select([self._receiver], [], [], _LOOK_EVERY_S)
            while self._receive():
                pass
            if now_s() - looked_s >= _LOOK_EVERY_S:
                looked_s = now_s()
                self._follow_route()

    # If an adapter disappears and returns with the same name and address, the system regards it as new. The old membership then receives
    # nothing. Joining again fails while the route leads to the same adapter.
    def _follow_route(self):
        try:
            self._receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, self._membership)
            (sender, own_address), receiver = self._open_sender(), self._open_receiver()
        except OSError:
            return  # the same adapter, or none at present
        for old in (self._sender, self._receiver):
            old.close()
        self._sender, self._own_address, self._receiver = sender, own_address, receiver
        _log.warning("the route to %s leads to another or a new adapter: joined the group there anew", self._group)

    # Reads all waiting datagrams before it handles any. If states come faster than they are handled, it continues with the newest.
    def _receive(self):
        messages = []
        for _ in range(_AT_ONCE):
            try:
                datagram, notes, _, source = self._receiver.recvmsg(_LARGEST_DATAGRAM, _NOTE_BYTES)
            except OSError:
                self._caught_up_s = now_s()
                break
            messages.append(self._understand(source, datagram, self._age_s(notes)))
        newest = {message[0]: i for i, message in enumerate(messages) if message is not None}
        for i, message in enumerate(messages):
            if message is not None and (newest[message[0]] == i or not message[0].endswith(b".STATE") or self.read_wholly[message[0]]):
                self._hand_over(*message)
        return len(messages) == _AT_ONCE

    def _age_s(self, notes):
        # The kernel's clock may be set. So the age is at most the time since the queue was last empty.
        stamps = [struct.unpack("@ll", note[:16]) for level, kind, note in notes if (level, kind) == (socket.SOL_SOCKET, _SO_TIMESTAMPNS)]
        age_s = time.time() - stamps[0][0] - 1e-9 * stamps[0][1] if stamps else 0.0
        return min(max(age_s, 0.0), now_s() - self._caught_up_s)

    def accept(self, source, datagram, age_s=0.0):
        """Takes one datagram of any content, received `age_s` ago. With ttl=0 it accepts only datagrams of this machine."""
        message = self._understand(source, datagram, age_s)
        if message is not None:
            self._hand_over(*message)

    def _understand(self, source, datagram, age_s):
        """(channel, message, time of receipt) if `datagram` completes a message, else None."""
        came_s = now_s() - age_s
        if self._ttl == 0 and source[0] != self._own_address and not source[0].startswith("127."):
            return None
        message = self._reassembly.take(source, datagram)
        return None if message is None else (*message, came_s)

    def _hand_over(self, channel, content, came_s):
        with self.changed:
            self.came_s = came_s
            self._note_joint(channel)
            for handler in self._handlers.get(channel, ()):
                method = handler()
                if method is not None:
                    method(content)
            self.changed.notify_all()

    def _note_joint(self, channel):
        name = _STATE_CHANNEL.fullmatch(channel)
        if name is None:
            return
        joint = (name[1].decode(), name[2].decode())
        if joint in self.joints or len(self.joints) < MAX_NAMES:
            self.joints[joint] = self.came_s


def now_s():
    """The monotonic clock, the only clock for ages and time-outs."""
    return time.monotonic()
