# SPDX-License-Identifier: BSD-3-Clause
"""Messages and their bytes, exact sizes only: a message of one type always has the same length (docs/messages.md)."""
import functools
import struct


class _Zeros:
    """Looks like a file of zeros, and counts how many were read."""

    def __init__(self):
        self.count = 0

    def read(self, size):
        self.count += size
        return bytes(size)


def blank(message_type):
    """A message with every field zero, text as zero bytes."""
    return message_type._decode_one(_Zeros())


@functools.lru_cache(maxsize=None)
def size_of(message_type):
    """Bytes on the wire: fingerprint and fields."""
    zeros = _Zeros()
    message_type._decode_one(zeros)
    return len(message_type._get_packed_fingerprint()) + zeros.count


def decode_exactly(message_type, data):
    """The message in `data`, or None when its length or its type is another."""
    if len(data) != size_of(message_type):
        return None
    try:
        return message_type.decode(bytes(data))
    except (ValueError, struct.error):
        return None


def text_of(padded):
    """Text of a zero-padded field, safe to print: control characters become question marks."""
    text = bytes(padded).split(b"\0", 1)[0].decode("utf-8", "replace")
    return "".join(character if character.isprintable() else "?" for character in text)
