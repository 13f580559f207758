# SPDX-License-Identifier: BSD-3-Clause
"""The published data of a joint, with named codes. docs/messages.md describes the fields."""
from .limits_v1 import limits_v1
from .messages import text_of
from .state_v1 import state_v1
from .vocabulary import Fault, Mode, Notice, TemperatureStatus, fault_words


class _Snapshot:
    """The fields of one message, copied once."""

    def __init__(self, message, received_s):
        for name in message.__slots__:
            setattr(self, name, getattr(message, name))
        self.received_s = received_s  # by this machine's monotonic clock

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"


class State(_Snapshot):
    """state_v1: the state of the joint in one cycle."""

    def __init__(self, message: state_v1, received_s):
        super().__init__(message, received_s)
        self.mode = Mode(message.mode)
        self.fault = Fault(message.fault)
        self.notices = Notice(message.notices & 0xFFFFFFFF)
        self.temperature_status = TemperatureStatus(message.temperature_status)
        # Only the entries for the rules of the table have a meaning.
        for field in ("temperature_weights", "friction_rule_C", "friction_scales"):
            setattr(self, field, tuple(getattr(message, field)[:max(0, message.rule_count)]))

    def fault_words(self):
        """The fault in words; for faults 5 and 26 with the details of drive_error."""
        return fault_words(self.fault, self.drive_error)

    def tracking_error_rad(self):
        """The setpoint position less the measured position, of the same cycle."""
        return self.setpoint_position_rad - self.joint_position_rad


class Limits(_Snapshot):
    """limits_v1: the model of the joint and its limits."""

    def __init__(self, message: limits_v1, received_s):
        super().__init__(message, received_s)
        self.joint_model = text_of(message.joint_model)
