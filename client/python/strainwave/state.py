# SPDX-License-Identifier: BSD-3-Clause
"""What the daemon publishes of a joint, with numbers by name. The fields are those of docs/messages.md."""
from .limits_v1 import limits_v1
from .messages import text_of
from .state_v1 import state_v1
from .vocabulary import Fault, Mode, Notice, TemperatureStatus, fault_words


class _Snapshot:
    """The fields of a message; does not change any more."""

    def __init__(self, message, received_s):
        for name in message.__slots__:
            setattr(self, name, getattr(message, name))
        self.received_s = received_s  # by this machine's monotonic clock

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"


class State(_Snapshot):
    """state_v1: what the joint does in one cycle."""

    def __init__(self, message: state_v1, received_s):
        super().__init__(message, received_s)
        self.mode = Mode(message.mode)
        self.fault = Fault(message.fault)
        self.notices = Notice(message.notices & 0xFFFFFFFF)
        self.temperature_status = TemperatureStatus(message.temperature_status)
        # Only as many as the table has rules mean anything.
        for field in ("temperature_weights", "friction_rule_C", "friction_scales"):
            setattr(self, field, tuple(getattr(message, field)[:max(0, message.rule_count)]))

    def fault_words(self):
        """The fault in words; with fault 5, which of its causes it was."""
        return fault_words(self.fault, self.drive_error)

    def tracking_error_rad(self):
        """Where the joint should be read in this cycle, less where it is read."""
        return self.setpoint_position_rad - self.joint_position_rad


class Limits(_Snapshot):
    """limits_v1: what the joint is and how far it may go."""

    def __init__(self, message: limits_v1, received_s):
        super().__init__(message, received_s)
        self.joint_model = text_of(message.joint_model)
