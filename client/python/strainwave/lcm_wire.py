# SPDX-License-Identifier: BSD-3-Clause
"""LCM's wire format over UDP multicast. The reader trusts no datagram. All numbers are big-endian.

  short:    u32 0x4c433032 "LC02", u32 sequence, channel, 0, the message
  fragment: u32 0x4c433033 "LC03", u32 sequence, u32 size of the whole message, u32 offset of this part in it,
            u16 number of this fragment, u16 count of fragments, in fragment 0 the channel and a zero, the part

Source: LCM 1.3.1, lcm/udpm_util.h and lcm/lcm_udpm.c; the same rules as in the daemon's reader (transport/lcm_wire.h,
lcm_reassembly.h). No received number determines the size of memory.
"""
import struct

SHORT_MAGIC = 0x4C433032
FRAGMENT_MAGIC = 0x4C433033
MAX_CHANNEL = 63
LARGEST_MESSAGE = 8120  # no message of Strainwave is longer
MAX_FRAGMENTS = 256
SLOTS = 32

_SHORT = struct.Struct(">II")
_FRAGMENT = struct.Struct(">IIIIHH")


def encode_short(sequence, channel, message):
    """The datagram of a message that fits into one, as every message of Strainwave does."""
    name = channel.encode("ascii")
    assert len(name) <= MAX_CHANNEL and len(message) <= LARGEST_MESSAGE
    return _SHORT.pack(SHORT_MAGIC, sequence & 0xFFFFFFFF) + name + b"\0" + message


def _split_channel(data, start):
    """The channel and the offset after it, or None."""
    end = data.find(0, start, start + MAX_CHANNEL + 1)
    return None if end < 0 else (data[start:end], end + 1)


class _Slot:
    def __init__(self, key):
        self.key = key
        size, count = key[1], key[2]
        self.message = bytearray(size)
        self.parts = [None] * count  # offset and size of each received part
        self.missing = count
        self.channel = b""

    def fits_together(self):
        """Whether the parts follow each other without gap or overlap, from the first byte to the last."""
        end = 0
        for offset, size in self.parts:
            if offset != end:
                return False
            end += size
        return end == len(self.message)


def _host_of(source):
    # A local program may send from any loopback address, so that all of these count as one host.
    return "127" if source[0].startswith("127.") else source[0]


class Reassembly:
    """Assembles messages from datagrams: one slot per source, SLOTS in all, each with one message of at most LARGEST_MESSAGE bytes.

    When all slots are taken, the host with the most slots loses its oldest one. So a host that opens many loses only its own.
    """

    def __init__(self):
        self.malformed = 0
        self._slots = {}  # by source, in the order of their first fragments

    def take(self, source, datagram):
        """(channel, message) as bytes if `datagram` from `source` (address, port) completes a message, else None. Any content is safe."""
        magic = int.from_bytes(datagram[:4], "big")
        if magic == SHORT_MAGIC and len(datagram) >= _SHORT.size:
            return self._take_short(datagram)
        if magic == FRAGMENT_MAGIC and len(datagram) >= _FRAGMENT.size:
            return self._take_fragment(source, datagram)
        return self._refuse()

    def _refuse(self):
        self.malformed += 1
        return None

    def _take_short(self, datagram):
        split = _split_channel(datagram, _SHORT.size)
        if split is None or len(datagram) - split[1] > LARGEST_MESSAGE:
            return self._refuse()
        return split[0], datagram[split[1]:]

    def _take_fragment(self, source, datagram):
        _, sequence, size, offset, number, count = _FRAGMENT.unpack_from(datagram)
        channel, start = b"", _FRAGMENT.size
        if number >= count or count > MAX_FRAGMENTS or size > LARGEST_MESSAGE:
            return self._refuse()
        if number == 0:
            split = _split_channel(datagram, start)
            if split is None or offset != 0:
                return self._refuse()
            channel, start = split
        part = datagram[start:]
        if offset + len(part) > size:
            return self._refuse()
        slot = self._slot_for(source, (sequence, size, count))
        if slot.parts[number] is not None:
            return None
        if number == 0:
            slot.channel = channel
        slot.parts[number] = (offset, len(part))
        slot.message[offset:offset + len(part)] = part
        slot.missing -= 1
        return self._finish(slot) if slot.missing == 0 else None

    def _finish(self, slot):
        # The slot stays, so that late copies of its fragments do not begin a new message.
        return (slot.channel, bytes(slot.message)) if slot.fits_together() else self._refuse()

    def _slot_for(self, source, key):
        slot = self._slots.get(source)
        if slot is not None and slot.key == key:
            return slot
        self._slots.pop(source, None)
        if len(self._slots) >= SLOTS:
            del self._slots[self._source_to_give_up(_host_of(source))]
        slot = self._slots[source] = _Slot(key)
        return slot

    def _source_to_give_up(self, newcomer):
        held = {newcomer: 1}
        for source, slot in self._slots.items():
            if slot.missing == 0:
                return source
            held[_host_of(source)] = held.get(_host_of(source), 0) + 1
        most = max(held.values())
        return next(source for source in self._slots if held[_host_of(source)] == most)
