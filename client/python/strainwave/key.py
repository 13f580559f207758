# SPDX-License-Identifier: BSD-3-Clause
"""The secret key on disk, and signatures: Ed25519 of libsodium, as in the daemon. Source: client/protocol/key_file.cc,
lcmtypes/key_text.cc, lcmtypes/signing.h.
"""
import base64
import binascii
import ctypes
import ctypes.util
import functools
import os
import stat

from .errors import InvalidInput, shown

SEAL_BYTES = 8 + 64  # key_id and signature, the last bytes of every order


@functools.lru_cache(maxsize=None)
def _sodium():
    for name in ("libsodium.so.23", ctypes.util.find_library("sodium")):
        try:
            sodium = ctypes.CDLL(name) if name else None
        except OSError:
            continue
        if sodium is not None and sodium.sodium_init() >= 0:
            return sodium
    raise InvalidInput("key: commands are signed with libsodium, which is not installed: apt install libsodium23")


class SecretKey:
    """An Ed25519 key; signs orders."""

    def __init__(self, seed):
        self._secret = ctypes.create_string_buffer(64)
        self._public = ctypes.create_string_buffer(32)
        _sodium().crypto_sign_seed_keypair(self._public, self._secret, bytes(seed))

    @property
    def public_bytes(self):
        return self._public.raw

    def sign(self, channel, message):
        """Returns `message` for `channel`, with key_id and signature in its last 72 bytes."""
        body = message[:-SEAL_BYTES]
        part = channel.encode("ascii") + b"\0" + body
        signature = ctypes.create_string_buffer(64)
        _sodium().crypto_sign_detached(signature, None, part, ctypes.c_ulonglong(len(part)), self._secret)
        return body + self._public.raw[:8] + signature.raw


def read_secret_key(path):
    """The key that strainwavectl keygen wrote to `path`."""
    if not isinstance(path, (str, os.PathLike)):
        raise InvalidInput(f"key = {shown(path)}: the name of a file is allowed, or None or '' for none")
    path = os.path.expanduser(os.fsdecode(path))
    try:
        with open(os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK), "rb") as file:
            mode = os.fstat(file.fileno()).st_mode
            line = file.read(512).split(b"\n", 1)[0] if stat.S_ISREG(mode) else None
    except (OSError, ValueError) as error:  # a name with a zero byte raises ValueError
        raise InvalidInput(f"key = {path!r}: the key cannot be read: {getattr(error, 'strerror', error)}") from None
    if line is None:
        raise InvalidInput(f"key = {path!r}: is not a file: give the file that strainwavectl keygen wrote")
    seed = _seed_of(path, line)  # checks the content first, because a public key may be readable by all
    if mode & (stat.S_IRWXG | stat.S_IRWXO):
        raise InvalidInput(f"key = {path!r}: other users can reach this secret key: chmod 600 {path}, and make a new key if they may "
                           "have read it")
    return SecretKey(seed)


def _seed_of(path, line):
    # Errors never quote the line, which may be secret.
    words = line.split(None, 2)
    if words[:1] == [b"ed25519"]:
        raise InvalidInput(f"key = {path!r}: this is a public key: give the file without .pub")
    if words[:1] != [b"ed25519-secret"] or len(words) < 2:
        raise InvalidInput(f"key = {path!r}: not a key of strainwavectl keygen")
    try:
        seed = base64.b64decode(words[1], validate=True)
    except binascii.Error:
        seed = b""
    if len(seed) != 32:
        raise InvalidInput(f"key = {path!r}: the key is not 32 bytes in base64 (44 characters): copy the whole line")
    return seed
