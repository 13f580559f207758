# SPDX-License-Identifier: BSD-3-Clause
"""Messages and their bytes. Only exact sizes are accepted: a message type has a fixed length (docs/messages.md)."""
import functools
import struct


class _Zeros:
    """Acts as a file of zeros, and counts the bytes read."""

    def __init__(self):
        self.count = 0

    def read(self, size):
        self.count += size
        return bytes(size)


def blank(message_type):
    """A message with zero in every field and zero bytes in texts."""
    return message_type._decode_one(_Zeros())


@functools.lru_cache(maxsize=None)
def size_of(message_type):
    """Encoded size in bytes: fingerprint and fields."""
    zeros = _Zeros()
    message_type._decode_one(zeros)
    return len(message_type._get_packed_fingerprint()) + zeros.count


def decode_exactly(message_type, data):
    """The message in `data`, or None if it has another length or type."""
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
