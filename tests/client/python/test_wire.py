# SPDX-License-Identifier: BSD-3-Clause
"""LCM's datagrams from untrusted senders."""
import random
import struct
import unittest

from strainwave import lcm_wire
from strainwave.lcm_wire import LARGEST_MESSAGE, SLOTS, Reassembly, encode_short

HERE = ("192.0.2.1", 5000)


def fragments(message, channel=b"SW.elbow.STATE", sequence=1, part_size=100):
    """Fragments as LCM sends them. Only the datagram of the first part contains the channel."""
    parts = [message[at:at + part_size] for at in range(0, len(message), part_size)]
    datagrams = []
    for number, part in enumerate(parts):
        header = struct.pack(">IIIIHH", lcm_wire.FRAGMENT_MAGIC, sequence, len(message), number * part_size, number, len(parts))
        datagrams.append(header + (channel + b"\0" if number == 0 else b"") + part)
    return datagrams


class ShortMessages(unittest.TestCase):
    def test_come_out_as_they_went_in(self):
        for message in (b"", b"x", bytes(range(256)), b"\0" * LARGEST_MESSAGE):
            self.assertEqual(Reassembly().take(HERE, encode_short(7, "SW.elbow.ACK", message)), (b"SW.elbow.ACK", message))

    def test_without_an_end_of_the_channel_or_too_long_are_refused(self):
        reassembly = Reassembly()
        header = struct.pack(">II", lcm_wire.SHORT_MAGIC, 1)
        for wrong in (header, header + b"SW", header + b"c" * 64 + b"\0", header + b"c\0" + b"\0" * (LARGEST_MESSAGE + 1)):
            self.assertIsNone(reassembly.take(HERE, wrong))
        self.assertEqual(reassembly.malformed, 4)
        self.assertEqual(reassembly.take(HERE, header + b"c" * 63 + b"\0m"), (b"c" * 63, b"m"))


class Fragments(unittest.TestCase):
    message = bytes(random.Random(1).randbytes(1234))

    def test_in_any_order_and_doubled_become_one_message(self):
        order = random.Random(2)
        for _ in range(50):
            datagrams = fragments(self.message) * 2
            order.shuffle(datagrams)
            reassembly = Reassembly()
            complete = [message for datagram in datagrams if (message := reassembly.take(HERE, datagram))]
            self.assertEqual(complete, [(b"SW.elbow.STATE", self.message)])

    def test_of_two_sources_do_not_mix(self):
        reassembly = Reassembly()
        other = bytes(reversed(self.message))
        complete = []
        for mine, others in zip(fragments(self.message), fragments(other)):
            complete += [reassembly.take(HERE, mine), reassembly.take(("192.0.2.2", 5000), others)]
        self.assertEqual([message[1] for message in complete if message], [self.message, other])

    def test_that_contradict_themselves_are_refused(self):
        pack = struct.Struct(">IIIIHH").pack
        magic = lcm_wire.FRAGMENT_MAGIC
        for header in (pack(magic, 1, 10, 0, 1, 1), pack(magic, 1, 10, 0, 0, 0), pack(magic, 1, 0xFFFFFFFF, 0, 1, 2),
                       pack(magic, 1, 10, 0xFFFFFFFF, 1, 2), pack(magic, 1, 10, 6, 1, 2), pack(magic, 1, 10, 5, 0, 2),
                       pack(magic, 1, 10, 0, 1, 0xFFFF)):
            reassembly = Reassembly()
            self.assertIsNone(reassembly.take(HERE, header + b"c\0" b"345"), header)
            self.assertEqual(reassembly.malformed, 1, header)

    def test_that_overlap_or_leave_a_gap_make_no_message(self):
        for wrong_offset in (0, 50, 150):
            datagrams = fragments(self.message[:300])
            datagrams[1] = datagrams[1][:12] + struct.pack(">I", wrong_offset) + datagrams[1][16:]
            reassembly = Reassembly()
            self.assertEqual([reassembly.take(HERE, datagram) for datagram in datagrams], [None] * 3)
            self.assertEqual(reassembly.malformed, 1)

    def test_of_a_host_with_many_ports_push_out_nobody_else(self):
        reassembly = Reassembly()
        mine = fragments(self.message)
        for datagram in mine[:-1]:
            reassembly.take(HERE, datagram)
        for port in range(10 * SLOTS):
            reassembly.take(("198.51.100.9", port), fragments(self.message, sequence=port)[0])
        self.assertEqual(reassembly.take(HERE, mine[-1]), (b"SW.elbow.STATE", self.message))

    def test_never_take_more_memory_than_the_slots_have(self):
        reassembly = Reassembly()
        chance = random.Random(3)
        for _ in range(3000):
            header = struct.pack(">IIIIHH", lcm_wire.FRAGMENT_MAGIC, chance.randrange(4), chance.randrange(LARGEST_MESSAGE + 1), 0,
                                 chance.randrange(1, 3), 300 if chance.random() < 0.1 else 256)
            reassembly.take((f"10.0.{chance.randrange(9)}.1", chance.randrange(9999)), header)
        slots = reassembly._slots.values()
        self.assertLessEqual(len(slots), SLOTS)
        self.assertLessEqual(sum(len(slot.message) for slot in slots), SLOTS * LARGEST_MESSAGE)


class HostileDatagrams(unittest.TestCase):
    def test_of_any_content_raise_nothing(self):
        chance = random.Random(4)
        reassembly = Reassembly()
        whole = fragments(bytes(1000)) + [encode_short(1, "SW.elbow.STATE", bytes(320))]
        for _ in range(20000):
            datagram = bytearray(chance.choice(whole)) if chance.random() < 0.7 else bytearray(chance.randbytes(chance.randrange(60)))
            for _ in range(chance.randrange(4)):
                if datagram:
                    datagram[chance.randrange(min(len(datagram), 24))] = chance.randrange(256)
            message = reassembly.take((f"192.0.2.{chance.randrange(5)}", chance.randrange(5)), bytes(datagram[:chance.randrange(1200)]))
            if message is not None:
                self.assertLessEqual(len(message[1]), LARGEST_MESSAGE)
        self.assertGreater(reassembly.malformed, 1000)


if __name__ == "__main__":
    unittest.main()
