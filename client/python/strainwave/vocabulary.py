"""The numbers that travel in messages, by name; docs/messages.md explains each.

A member is its number; `text` is what strainwavectl and the log call it. A number that this version does not know is a member, too,
named UNKNOWN_<number>: a newer daemon breaks no program.
"""
import enum


class _Word(enum.IntEnum):
    def __new__(cls, number, text):
        return cls._make(number, text)

    @classmethod
    def _make(cls, number, text):
        member = int.__new__(cls, number)
        member._value_ = number
        member.text = text
        return member

    @classmethod
    def _missing_(cls, value):
        if not isinstance(value, int):
            return None
        member = cls._make(value, "unknown")
        member._name_ = f"UNKNOWN_{value}"
        return member

    def __str__(self):
        return self.text

    def __format__(self, spec):
        return format(self.text, spec)


class Mode(_Word):
    """state_v1.mode."""

    OFF = 0, "off"
    STARTING = 1, "starting"
    HOLDING = 2, "holding"
    TRACKING = 3, "tracking"
    STOPPING = 4, "stopping"
    FAULTED = 5, "faulted"
    HOMING = 6, "homing"
    RELEASING = 7, "releasing"


class Fault(_Word):
    """state_v1.fault: latched, the joint is stopped."""

    NONE = 0, "none"
    READ_FAILED = 1, "position reading failed"
    WRITE_REFUSED = 2, "torque command refused by the drive"
    DRIVE_FAULT = 3, "drive fault"
    POWER_LOST = 4, "supply lost"
    IMPLAUSIBLE_READING = 5, "implausible reading"
    LINK_LOST = 6, "link to the drive lost"
    EMERGENCY_STOP = 7, "emergency stop"
    DRIVE_RESTARTED = 8, "drive restarted by itself"
    BUS_ERROR = 9, "bus error"
    START_TIMEOUT = 10, "drive did not enable in time"
    STOP_TIMEOUT = 11, "joint did not stop in time"
    POSITION_LIMIT = 12, "position limit"
    SPEED_LIMIT = 13, "speed limit"
    FOLLOWING_ERROR = 14, "following error"
    NOT_FINITE = 15, "not-a-number in the loop"
    OVERRUNS = 16, "too many overruns in a row"
    TEMPERATURE_LIMIT = 17, "temperature limit"
    GROUP = 18, "another joint of the group faulted"
    HOMING_FAILED = 19, "homing failed"
    LIMIT_SWITCH = 20, "limit switch"
    LOOP_STALLED = 21, "loop stalled"
    PERIODS_MISSED = 22, "too many periods missed"
    BLOCKED = 23, "joint is blocked"
    OVERLOAD = 24, "load too large"
    TEMPERATURE_LOST = 25, "temperature lost"
    CHATTER = 26, "joint chatters"


class Reason(_Word):
    """ack_v1.reason: why an order was refused."""

    ACCEPTED = 0, "accepted"
    MALFORMED = 1, "malformed message"
    NOT_FINITE = 2, "not a finite number"
    OUT_OF_RANGE = 3, "out of range"
    WRONG_MODE = 4, "not possible in this mode"
    NO_TABLE = 5, "no gain table loaded"
    UNKNOWN_JOINT = 6, "unknown joint"
    WRONG_SESSION = 7, "another session of the daemon"
    OLD_SEQUENCE = 8, "sequence not rising"
    UNSIGNED = 9, "not signed"
    BAD_SIGNATURE = 10, "wrong signature"
    ROLE_NOT_ALLOWED = 11, "role not allowed to do this"
    TABLE_DEFECT = 12, "table has a defect"
    TABLE_IDENTITY = 13, "table is for another joint"
    TABLE_PERIOD = 14, "table is for another period"
    TABLE_NOT_CERTIFIED = 15, "table not certified for this joint"
    FAULTED = 16, "joint is faulted"
    BUSY = 17, "busy, try again"
    MOVING = 18, "joint is moving"
    NO_PREVIOUS_TABLE = 19, "no previous table"
    UNKNOWN_ACTION = 20, "unknown action"
    TIMED_OUT = 21, "timed out"
    DRIVE_NOT_READY = 22, "drive not ready"
    SUPERSEDED = 23, "superseded by a newer command"
    NOT_SIMULATED = 24, "only a simulated drive takes injected faults"
    STREAM_ENDED = 25, "setpoint stream has ended"
    NOT_HOMED = 26, "joint is not homed"
    AT_LIMIT_SWITCH = 27, "limit switch in that direction"
    NO_HOMING = 28, "no homing configured"
    ENDING = 29, "daemon is ending"
    TOO_OLD = 30, "order is too old"
    NOT_OWNER = 31, "another client has the joint"
    FAR_FROM_JOINT = 32, "stream begins far from the joint"
    VELOCITIES_CONTRADICT = 33, "velocities contradict positions"


class Action(_Word):
    """command_v1.action."""

    ENABLE = 1, "enable"
    DISABLE = 2, "disable"
    HOLD = 3, "hold"
    CLEAR_FAULT = 4, "clear-fault"
    REVERT_TABLE = 5, "revert-table"
    HOME = 6, "home"
    TAKE_OVER = 7, "take-over"
    RELEASE = 8, "release"
    PAUSE = 9, "pause"
    RESUME = 10, "resume"
    RESET_LEARNING = 11, "reset-learning"
    FREEZE_LEARNING = 12, "freeze-learning"
    RESUME_LEARNING = 13, "resume-learning"


class TemperatureStatus(_Word):
    """state_v1.temperature_status."""

    VALID = 0, "valid"
    NEVER_SEEN = 1, "never seen"
    TOO_OLD = 2, "too old"
    OUT_OF_RANGE = 3, "out of range"
    TOO_FAST = 4, "changing too fast"
    NOT_CHANGING = 5, "not changing"


class GainsInUse(_Word):
    """state_v1.gains_in_use."""

    NONE = 0, "none"
    PRIMARY = 1, "scheduled"
    FALLBACK = 2, "temperature-free"


class Notice(enum.IntFlag, boundary=enum.KEEP):
    """state_v1.notices, a set: limits that are in force; the joint goes on."""

    TORQUE_LIMITED = 1 << 0
    TEMPERATURE_CLAMPED = 1 << 1
    FALLBACK_GAINS = 1 << 2
    SETPOINT_EXPIRED = 1 << 3
    READING_MISSED = 1 << 4
    SPEED_LIMITED = 1 << 5
    NOT_HOMED = 1 << 6
    AT_LIMIT_SWITCH = 1 << 7
    OFF_STREAM = 1 << 9
    POSITION_LATE = 1 << 10
    OFF_TARGET = 1 << 11
    LOAD_HIGH = 1 << 12
    OTHER_INERTIA = 1 << 13
    PATH_PAUSED = 1 << 14
    PATH_ENDS = 1 << 15
    YIELDED = 1 << 16
    SAMPLES_MISSING = 1 << 17
    FRICTION_DIFFERS = 1 << 18
    VELOCITIES_CONTRADICT = 1 << 19

    @property
    def texts(self):
        """In words, one for each that is in force."""
        return [_NOTICE_TEXTS.get(bit, "unknown") for bit in (1 << i for i in range(32)) if int(self) & bit]

    def __str__(self):
        return ", ".join(self.texts)

    def __format__(self, spec):
        return format(str(self), spec)


_NOTICE_TEXTS = {
    Notice.TORQUE_LIMITED: "torque limited",
    Notice.TEMPERATURE_CLAMPED: "temperature outside the table",
    Notice.FALLBACK_GAINS: "temperature-free gains in use",
    Notice.SETPOINT_EXPIRED: "setpoint stream expired",
    Notice.READING_MISSED: "reading missed",
    Notice.SPEED_LIMITED: "speed limited",
    Notice.NOT_HOMED: "not homed",
    Notice.AT_LIMIT_SWITCH: "at a limit switch",
    Notice.OFF_STREAM: "off the stream",
    Notice.POSITION_LATE: "position late",
    Notice.OFF_TARGET: "off target",
    Notice.LOAD_HIGH: "load high",
    Notice.OTHER_INERTIA: "inertia not as told",
    Notice.PATH_PAUSED: "path paused",
    Notice.PATH_ENDS: "path ends early",
    Notice.YIELDED: "yielded to a load",
    Notice.SAMPLES_MISSING: "samples missing",
    Notice.FRICTION_DIFFERS: "friction differs from the table",
    Notice.VELOCITIES_CONTRADICT: "velocities contradict positions",
}


_READING_DOUBTS = {
    1: "the position is not a number",
    2: "the velocity is not a number",
    3: "the torque is not a number",
    4: "the position jumped by {} from one reading to the next",
    5: "the position stands still though the torque must have moved the joint by {}",
    6: "counts of the encoder are missing or wrong",
}


def _evidence_words(number):
    ratio = (number >> 24) / 32
    words = f"the torque reversed {number & 0xFFF} times within a second, by up to {(number >> 12 & 0xFFF) / 16:.3g} N.m"
    if ratio > 0:
        words += f"; motions show {ratio:.2g} times the configured inertia"
    if ratio > 0 and abs(ratio - 1) > 0.3:
        return words + ": check load_inertia_kgm2 and motor_inertia_kgm2 (inertia_kgm2)"
    return words + ": check delay_periods, the encoder's side, the gear and the load"


def fault_words(fault, drive_error):
    """The fault in words, of faults 5 and 26 with what state_v1.drive_error says of them (docs/faults.md)."""
    if fault == Fault.CHATTER and 0 < drive_error <= 0xFFFFFFFF:
        return f"{fault.text}: {_evidence_words(drive_error)}"
    size_urad = drive_error & 0xFFFFFF
    doubt = _READING_DOUBTS.get(drive_error >> 24)
    if fault != Fault.IMPLAUSIBLE_READING or doubt is None:
        return fault.text
    return f"{fault.text}: " + doubt.format(f"{1e-6 * size_urad:.6g} rad" + (" or more" if size_urad == 0xFFFFFF else ""))
