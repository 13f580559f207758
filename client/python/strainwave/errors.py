# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong, as exceptions. Each says what was given, what is allowed or what the daemon answered, and what to do."""
import reprlib


def shown(value):
    """What was given, for an error: short, and of anything. repr() refuses a number of more than 4300 digits."""
    try:
        return reprlib.repr(value)
    except Exception:
        return f"<{type(value).__name__}>"


class StrainwaveError(Exception):
    """Any of the following.

    each: of several joints the error of each that was stopped; all else of this one is of the first. Of one joint it is empty.
    """

    each = ()


class InvalidInput(StrainwaveError, ValueError):
    """Refused here, before anything was sent: a name, a number, a URL or a key file."""


class NoAnswer(StrainwaveError, TimeoutError):
    """No daemon, no such joint, silence, or a network without multicast. Whether an order was carried out is not known."""


class Refused(StrainwaveError):
    """The daemon answered and refused.

    joint, order: what was asked of whom, in words; reason: Reason; text: the daemon's own words, with the numbers that led to it.
    """

    def __init__(self, joint, order, reason, text="", hint=""):
        words = f"{joint}: {order} refused ({int(reason)}, {reason.text})"
        super().__init__("; ".join(part for part in (f"{words}: {text}" if text else words, hint) if part))
        self.joint, self.order, self.reason, self.text = joint, order, reason, text


class Faulted(StrainwaveError):
    """The joint has a latched fault. fault: Fault; `words`: its text, with the cause where that is known."""

    def __init__(self, joint, fault, words=""):
        super().__init__(f"{joint}: faulted ({int(fault)}: {words or fault.text}); once the cause is gone: Joint.clear_fault()")
        self.joint, self.fault = joint, fault


class NotDone(StrainwaveError):
    """An order that was accepted did not come to its end: another replaced it, the joint was disabled, it holds elsewhere."""


class Yielded(NotDone):
    """The joint yielded to a load, which ended its motion; it has no fault, and holds as soon as it rests.

    load_Nm: above 0 pushes towards negative positions; limit_Nm: what load was allowed; position_rad: where the joint was.
    """

    def __init__(self, joint, message, load_Nm, limit_Nm, position_rad):
        super().__init__(f"{joint}: {message}")
        self.joint, self.load_Nm, self.limit_Nm, self.position_rad = joint, load_Nm, limit_Nm, position_rad
