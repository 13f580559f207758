# SPDX-License-Identifier: BSD-3-Clause
"""Compares messages and signatures with those of the C++ side, and tests the texts for numbers."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import strainwave
from strainwave import messages, sender, stream, vocabulary
from strainwave.errors import InvalidInput
from strainwave.key import SecretKey, read_secret_key

SOURCE = pathlib.Path(os.environ["STRAINWAVE_SOURCE_DIR"])
TYPES = ("ack_v1", "command_v1", "gain_table_v1", "inject_v1", "limits_v1", "path_v1", "setpoint_v1", "state_v1", "temperature_v1", "timing_v1")
SAMPLES = dict(line.split() for line in subprocess.run([os.environ["STRAINWAVE_PYTHON_SAMPLES"]], check=True, capture_output=True,
                                                       text=True).stdout.splitlines())


def sample(name):
    return bytes.fromhex(SAMPLES[name])


def a_setpoint():
    message = messages.blank(strainwave.setpoint_v1)
    values = dict(utime=1, session_id=-2, challenge=3, sender_id=4, sequence=5, stream_id=6, position_rad=0.25, velocity_rad_s=-1.5,
                  acceleration_rad_s2=1e-300, torque_Nm=-3.5, load_inertia_kgm2=0.125, at_cycle=7, derivatives=2, valid_for_s=0.5,
                  speed_limit_rad_s=2.0, begins_stream=1, approach=1)
    for name, value in values.items():
        setattr(message, name, value)
    return message


class Messages(unittest.TestCase):
    def test_of_every_type_survive_the_way_through_python(self):
        for name in TYPES:
            with self.subTest(name):
                message = messages.decode_exactly(getattr(strainwave, name), sample(name))
                self.assertIsNotNone(message)
                self.assertEqual(message.encode(), sample(name))

    def test_have_the_bytes_that_cpp_gives_them(self):
        self.assertEqual(a_setpoint().encode(), sample("unsigned_setpoint"))

    def test_of_every_declared_type_are_exported(self):
        declared = {name for file in (SOURCE / "lcmtypes").glob("*.lcm") for name in re.findall(r"^struct (\w+)", file.read_text(), re.M)}
        self.assertEqual(declared, {name for name in vars(strainwave) if re.fullmatch(r"[a-z_]+_v\d+", name)})
        for name in declared:
            self.assertIsInstance(getattr(strainwave, name), type)

    def test_of_another_length_or_type_are_none(self):
        whole = sample("state_v1")
        for wrong in (b"", whole[:7], whole[:-1], whole + b"\0", b"\0" * len(whole), sample("ack_v1")):
            self.assertIsNone(messages.decode_exactly(strainwave.state_v1, wrong))

    def test_cannot_write_control_characters_to_a_terminal(self):
        self.assertEqual(messages.text_of(b"a\x1b[2J\nb\xff\0hidden"), "a?[2J?b\ufffd")


class Signatures(unittest.TestCase):
    def test_are_those_of_cpp(self):
        key = SecretKey(bytes(range(32)))
        self.assertEqual(key.public_bytes, sample("public_key"))
        self.assertEqual(key.sign("SW.elbow.SETPOINT", a_setpoint().encode()), sample("signed_setpoint"))

    def test_belong_to_one_channel(self):
        key = SecretKey(bytes(range(32)))
        self.assertNotEqual(key.sign("SW.wrist.SETPOINT", a_setpoint().encode()), sample("signed_setpoint"))

    def test_are_given_under_the_identity_that_strainwavectl_has(self):
        self.assertEqual(sender.own_identity(), int(SAMPLES["identity"]))


class KeyFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "key"

    def write(self, text, mode=0o600):
        self.path.write_text(text)
        self.path.chmod(mode)

    def refusal(self):
        with self.assertRaises(InvalidInput) as caught:
            read_secret_key(self.path)
        self.assertIn(str(self.path), str(caught.exception))
        return str(caught.exception)

    def test_of_keygen_are_read(self):
        self.write("ed25519-secret AAECAwQFBgcICQoLDA0ODxAREhMUFRYXGBkaGxwdHh8= operator Otto, cell 3\n")
        self.assertEqual(read_secret_key(self.path).public_bytes, sample("public_key"))

    def test_that_cannot_be_used_say_why_and_never_what_is_in_them(self):
        self.assertIn("cannot be read", self.refusal())
        secret = "AAECAwQFBgcICQoLDA0ODxAREhMUFRYXGBkaGxwdHh8="
        for text, mode, reason in ((f"ed25519-secret {secret} operator\n", 0o640, "chmod 600"),
                                   (f"ed25519 {secret} operator\n", 0o600, "public key"),
                                   (f"{secret}\n", 0o600, "not a key of strainwavectl keygen"),
                                   (f"ed25519-secret {secret[:40]} operator\n", 0o600, "44 characters"), ("", 0o600, "not a key")):
            self.write(text, mode)
            refusal = self.refusal()
            self.assertIn(reason, refusal)
            self.assertNotIn(secret[:40], refusal)

    def test_that_are_no_files_are_refused_without_waiting(self):
        os.mkfifo(self.path, 0o600)
        self.assertIn("is not a file", self.refusal())


class Vocabulary(unittest.TestCase):
    def test_lets_a_stream_be_silent_for_as_long_as_the_header_does(self):
        header = (SOURCE / "lcmtypes/stream_validity.h").read_text()
        self.assertEqual(stream.LONGEST_VALID_FOR_S, float(re.search(r"kLongestValidFor_s = ([\d.]+);", header)[1]))

    def test_tells_of_faults_in_the_words_of_cpp(self):
        faults = [name for name in SAMPLES if name.startswith("fault_")]
        self.assertGreater(len(faults), 10)
        for name in faults:
            _, fault, drive_error = name.split("_")
            self.assertEqual(vocabulary.fault_words(vocabulary.Fault(int(fault)), int(drive_error)), sample(name).decode(), name)

    def test_takes_numbers_of_a_newer_daemon(self):
        self.assertEqual((int(vocabulary.Reason(77)), f"{vocabulary.Reason(77)}"), (77, "unknown"))
        self.assertEqual(vocabulary.Notice(1 | 1 << 30).texts, ["torque limited", "unknown"])


if __name__ == "__main__":
    unittest.main()
