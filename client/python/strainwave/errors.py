# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions. Each names the given value, the allowed range or the daemon's answer, and the remedy."""
import reprlib


def shown(value):
    """A short text of any value for an error message. repr() refuses a number of more than 4300 digits."""
    try:
        return reprlib.repr(value)
    except Exception:
        return f"<{type(value).__name__}>"


class StrainwaveError(Exception):
    """Base class of the following.

    each: for several joints the errors of all stopped joints; the other attributes belong to the first. For one joint it is empty.
    """

    each = ()


class InvalidInput(StrainwaveError, ValueError):
    """Refused here, before anything was sent: a name, a number, a URL or a key file."""


class NoAnswer(StrainwaveError, TimeoutError):
    """No daemon, no such joint, silence, or a network without multicast. Whether an order was carried out is not known."""


class Refused(StrainwaveError):
    """The daemon answered and refused.

    joint, order: the joint and the refused order, in words; reason: Reason; text: the daemon's explanation with numbers.
    """

    def __init__(self, joint, order, reason, text="", hint=""):
        words = f"{joint}: {order} refused ({int(reason)}, {reason.text})"
        super().__init__("; ".join(part for part in (f"{words}: {text}" if text else words, hint) if part))
        self.joint, self.order, self.reason, self.text = joint, order, reason, text


class Faulted(StrainwaveError):
    """The joint has a latched fault. fault: Fault; `words`: its text, with the cause if known."""

    def __init__(self, joint, fault, words=""):
        super().__init__(f"{joint}: faulted ({int(fault)}: {words or fault.text}); once the cause is gone: Joint.clear_fault()")
        self.joint, self.fault = joint, fault


class NotDone(StrainwaveError):
    """An accepted order was not completed: another order replaced it, the joint was disabled, or it holds elsewhere."""


class Yielded(NotDone):
    """The joint yielded to a load, which ended its motion; it has no fault, and holds as soon as it rests.

    load_Nm: > 0 pushes towards negative positions; limit_Nm: the allowed load; position_rad: the joint's position then.
    """

    def __init__(self, joint, message, load_Nm, limit_Nm, position_rad):
        super().__init__(f"{joint}: {message}")
        self.joint, self.load_Nm, self.limit_Nm, self.position_rad = joint, load_Nm, limit_Nm, position_rad
