# SPDX-License-Identifier: BSD-3-Clause
"""Seals orders: only this module fills in identity, session, sequence and signature. Source: client/protocol/sender.h."""
import os
import socket
import threading
import time

from .key import read_secret_key


# Sequences rise with the clock, in microseconds. No real answer of a daemon comes near this value.
LARGEST_SEQUENCE = 2**62


def identity(name):
    """62 bits from `name`, never 0: FNV-1a, as in strainwavectl."""
    value = 0xCBF29CE484222325
    for byte in name.encode():
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return (value >> 2) + 1


def own_identity():
    """The identity of this user on this machine. Successive programs of the user, also strainwavectl, own the same joints."""
    try:
        with open("/etc/machine-id", encoding="ascii", errors="replace") as file:
            machine = "".join(file.read().split()[:1])
    except OSError:
        machine = ""
    return identity(f"{machine}/{socket.gethostname()}/{os.getuid()}")


class Sender:
    """Seals orders. `key`: the file of the secret key, read now; None or "": orders go out unsigned."""

    def __init__(self, key=None):
        self.sender_id = own_identity()
        self._key = None if key is None or key == "" else read_secret_key(key)
        self._sequence = 0
        self._lock = threading.Lock()

    def next_sequence(self, utime=None):
        """Larger than every earlier sequence of this sender. Through the clock, it also exceeds those of other programs with the key."""
        with self._lock:
            self._sequence = max(self._sequence + 1, time.time_ns() // 1000 if utime is None else utime)
            return self._sequence

    def rise_above(self, sequence):
        """Makes the next sequence larger, after another program with this key was ahead. Ignores values that no daemon sends."""
        with self._lock:
            if sequence < LARGEST_SEQUENCE:
                self._sequence = max(self._sequence, sequence)

    def seal(self, channel, message, state):
        """Completes `message` for the daemon of `state` (None: any daemon, for a stop) and returns its bytes."""
        message.utime = time.time_ns() // 1000
        message.session_id = state.session_id if state else 0
        message.challenge = state.challenge if state else 0
        message.sender_id = self.sender_id
        message.sequence = self.next_sequence(message.utime)
        encoded = message.encode()
        return self._key.sign(channel, encoded) if self._key else encoded
