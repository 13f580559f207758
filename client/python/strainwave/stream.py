# SPDX-License-Identifier: BSD-3-Clause
"""A stream of setpoints: positions of the joint at given times. docs/streams.md."""
import math

from .errors import InvalidInput, NoAnswer, NotDone, Refused, StrainwaveError, shown
from .messages import blank
from .motion import OLD_STATES_S, degrees_hint, faulted, has_yielded, yielded
from .network import now_s
from .setpoint_v1 import setpoint_v1
from .vocabulary import Mode, Reason

FARTHEST_AHEAD_S = 0.9  # the daemon allows 1 s; the transmission takes part of it
_LARGEST_T_S = 1e12  # a cycle of this time fits into a message
_LONGEST_STEP_S = 0.5  # without samples a joint comes to rest after 0.2 s
_ANOTHER_ONE = "this stream is over; Joint.stream() opens a new one"
LONGEST_VALID_FOR_S = 10.0  # kLongestValidFor_s of the daemon


def check_number(name, value, allowed, is_allowed, joint="", keys="", hint=lambda number: ""):
    """`value` as a float if it is a finite and allowed number, not a text or a truth value. `joint`: the joint it belongs to, if any;
    `keys`: the configuration keys of the daemon that set the limit; hint(number): added to the error for a finite number.
    """
    try:
        if isinstance(value, (str, bytes, bool)):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number) or not is_allowed(number):
        words = f"{joint}{': ' if joint else ''}{name} = {shown(value)}: {allowed} is allowed" + (f" ({keys} of {joint})" if keys else "")
        raise InvalidInput("; ".join(part for part in (words, hint(number) if math.isfinite(number) else "") if part))
    return number


class TimeBase:
    """Relates the time t of a stream to the daemon's cycles. Joints that move together share it."""

    def __init__(self):
        self.origin_t = None
        self.origin_cycle = 0

    def cycle_of(self, t, period_s):
        return self.origin_cycle + round((t - self.origin_t) / period_s)


class Stream:
    """Made by Joint.stream(). Use it in a with-statement: at its end the joint comes to rest and holds."""

    def __init__(self, joint, conversation, period_s, ahead_s, valid_for_s, speed_limit_rad_s, approach, beside):
        self.late = 0  # samples after their time, or after a later sample: left out, or refused by the daemon
        self.outdated = 0  # samples that the daemon refused because they quoted an old state
        self._joint, self._conversation, self._period_s = joint, conversation, period_s
        self._ahead_s = self._checked("ahead_s", ahead_s, f"above 0 to {FARTHEST_AHEAD_S}", lambda s: 0 < s <= FARTHEST_AHEAD_S)
        self._valid_for_s = self._checked("valid_for_s", valid_for_s, f"above 0 to {LONGEST_VALID_FOR_S:g}", lambda s: 0 < s <= LONGEST_VALID_FOR_S)
        self._speed_limit_rad_s = speed_limit_rad_s
        if not isinstance(approach, bool):
            raise InvalidInput(f"{joint.name}: approach = {shown(approach)}: True or False is allowed")
        self._approach = approach
        if beside is not None and not isinstance(beside, Stream):
            raise InvalidInput(f"{joint.name}: beside = {shown(beside)}: a Stream is allowed, of another joint's stream()")
        if beside is not None:
            conversation.require_same_daemon(beside._conversation, "streams beside each other")
        self._base = TimeBase() if beside is None else beside._base
        self._stream_id = conversation.sender.next_sequence()
        self._last_t = None
        self._last_cycle = None  # of the last sample that was sent; None: the stream has not begun, or is over
        self._first_cycle = 0  # of the first sample
        self._session_id = 0  # of the daemon at the begin
        self._over = False  # closed, or ended by another client or the daemon

    def put(self, t, position_rad, velocity_rad_s=None, acceleration_rad_s2=None, *, torque_Nm=0.0, load_inertia_kgm2=0.0):
        """Orders `position_rad` for time `t` (s; increasing by 0.5 s at most; the first is `ahead_s` from now), with velocity and acceleration
        if they are known. `torque_Nm` is added to the planned torque (gravity, contact). `load_inertia_kgm2` is added to the joint's own inertia.
        Waits until the sample is due, `ahead_s` before its time, so that a loop over t runs at the joint's pace. True: it was sent in time;
        a later put() reports a refusal. False: it was left out, because its time is over. Raises Refused, Faulted, Yielded, NotDone (also
        when the stream is over), NoAnswer, InvalidInput.
        """
        if self._over:  # a later sample does not restart the stream: another client may have ended it for a reason
            raise NotDone(f"{self._joint.name}: {_ANOTHER_ONE}")
        if self._last_cycle is not None:
            self._check_restart()
        t = self._checked("t", t, f"a finite time in s, from -{_LARGEST_T_S:g} to {_LARGEST_T_S:g} and above the last one",
                          lambda s: abs(s) <= _LARGEST_T_S and (self._last_t is None or s > self._last_t))
        message = self._message(position_rad, velocity_rad_s, acceleration_rad_s2)
        most_Nm = self._joint.limits.torque_limit_Nm
        message.torque_Nm = self._checked("torque_Nm", torque_Nm, f"from {-most_Nm} to {most_Nm}", lambda Nm: abs(Nm) <= most_Nm,
                                          "joint.limits.torque_limit_Nm")
        message.load_inertia_kgm2 = self._checked("load_inertia_kgm2", load_inertia_kgm2, "a number from 0", lambda kgm2: kgm2 >= 0)
        self._last_t = t
        if self._last_cycle is None:
            return self._begin(t, message)
        message.at_cycle = self._base.cycle_of(t, self._period_s)
        if message.at_cycle <= self._last_cycle:
            raise InvalidInput(f"{self._joint.name}: t = {t!r}: a time of at least {self._period_s} s (the daemon's period) after the last one is allowed")
        self._wait_until_due(message.at_cycle)
        self._wait_for_new_states(message.at_cycle)
        self._check_refusals()
        if message.at_cycle <= self._now_cycle() or self._conversation.is_behind:
            return self._leave_out(message.at_cycle)
        self._conversation.send("SETPOINT", message)
        self._last_cycle = message.at_cycle
        return True

    def cycle_of(self, t):
        """The daemon's cycle for the sample of time `t`, in the count of `state.cycle`, to compare the order with the motion. Raises NotDone
        before the first put(), which sets the time, and InvalidInput."""
        t = self._checked("t", t, f"a finite time in s, from -{_LARGEST_T_S:g} to {_LARGEST_T_S:g}", lambda s: abs(s) <= _LARGEST_T_S)
        if self._base.origin_t is None:
            raise NotDone(f"{self._joint.name}: the stream has not begun: its first put() sets its time")
        return self._base.cycle_of(t, self._period_s)

    def close(self):
        """Waits for the last sample's time, ends the stream and waits until the joint holds."""
        self._over = True
        if self._last_cycle is None:
            return
        network, conversation = self._conversation.network, self._conversation
        try:
            self._check_refusals()
            if not network.wait_until(lambda: self._restarted() or conversation.state.cycle >= self._last_cycle,
                                      self._ahead_s + conversation.timeout_s):
                raise conversation.fell_silent("lost contact with strainwaved before the stream's end")
            self._check_refusals()
        finally:
            if self._last_cycle is not None:
                self._last_cycle = None
                self._joint.hold()

    def __enter__(self):
        return self

    def __exit__(self, kind, error, traceback):
        if error is None:
            self.close()
            return
        self._over = True
        try:
            if self._last_cycle is not None:
                self._joint.hold()
        except StrainwaveError as second:
            error.add_note(f"and the hold did not reach the joint: {second}")

    def _checked(self, name, value, allowed, is_allowed, keys="", hint=lambda number: ""):
        return check_number(name, value, allowed, is_allowed, self._joint.name, keys, hint)

    def _message(self, position_rad, velocity_rad_s, acceleration_rad_s2):
        limits = self._joint.limits
        message = blank(setpoint_v1)
        message.position_rad = self._checked(
            "position_rad", position_rad, f"from {limits.position_min_rad} to {limits.position_max_rad}",
            lambda rad: limits.position_min_rad <= rad <= limits.position_max_rad,
            "joint.limits.position_min_rad and position_max_rad", degrees_hint)
        if velocity_rad_s is not None:
            message.velocity_rad_s = self._checked("velocity_rad_s", velocity_rad_s, "a finite number", lambda _: True)
            message.derivatives = 1
        if acceleration_rad_s2 is not None:
            if velocity_rad_s is None:
                raise InvalidInput(f"{self._joint.name}: acceleration_rad_s2 = {acceleration_rad_s2!r}: allowed only with velocity_rad_s")
            message.acceleration_rad_s2 = self._checked("acceleration_rad_s2", acceleration_rad_s2, "a finite number", lambda _: True)
            message.derivatives = 2
        message.stream_id = self._stream_id
        message.valid_for_s = self._valid_for_s
        message.speed_limit_rad_s = self._speed_limit_rad_s
        return message

    def _begin(self, t, message):
        message.begins_stream = 1
        message.acknowledge = 1
        message.approach = int(self._approach)
        sets_the_base = self._base.origin_t is None
        self._conversation.forget_sent()

        def prepare(again):
            if sets_the_base:
                self._base.origin_t = t
                self._base.origin_cycle = math.ceil(self._now_cycle() + self._ahead_s / self._period_s)
            again.at_cycle = self._base.cycle_of(t, self._period_s)

        self._conversation.request("SETPOINT", message, f"the first setpoint of the stream, {message.position_rad} rad,", prepare)
        self._last_cycle = self._first_cycle = message.at_cycle
        self._session_id = self._conversation.state.session_id
        return True

    def _now_cycle(self):
        with self._conversation.network.changed:
            return self._conversation.clock.cycle_at(now_s(), self._period_s)

    def _wait_until_due(self, cycle):
        wait_s = (cycle - self._now_cycle()) * self._period_s - self._ahead_s
        if wait_s > _LONGEST_STEP_S:
            raise InvalidInput(f"{self._joint.name}: t = {self._last_t!r}: due in {wait_s:.4g} s, at most {_LONGEST_STEP_S} is allowed: "
                               "t counts seconds, not milliseconds")
        # A refusal ends the wait at once, so that put() can report it.
        self._conversation.network.wait_until(lambda: self._conversation.has_refusals or self._restarted(), max(0.0, wait_s))

    # The daemon refuses samples that quote an old state. After a stall of this program, it first takes the states that arrived meanwhile.
    def _wait_for_new_states(self, cycle):
        conversation = self._conversation
        if conversation.is_behind:
            conversation.network.wait_until(lambda: not conversation.is_behind, max(0.0, (cycle - self._now_cycle()) * self._period_s))

    def _check_refusals(self):
        # A fault or a yield of the joint is reported before the refusals that it caused.
        self._check_state(self._first_cycle)
        while (refusal := self._conversation.take_refusal()) is not None:
            reason, text, overtaken = refusal
            late = reason == Reason.CYCLE_IS_OVER or overtaken
            if not late and reason != Reason.TOO_OLD:
                if reason in (Reason.FAULTED, Reason.STREAM_ENDED, Reason.WRONG_SESSION):
                    self._check_joint()
                ends = reason in (Reason.STREAM_ENDED, Reason.SUPERSEDED, Reason.WRONG_SESSION, Reason.VELOCITIES_CONTRADICT)
                if ends:
                    self._lose()
                raise Refused(self._joint.name, "a setpoint of the stream", reason, text, self._why_it_ended() if ends else "")
            if late:
                self.late += 1
            else:
                self.outdated += 1

    def _why_it_ended(self):
        counts = f"{self.late} of its samples came late, {self.outdated} quoted an old state; " if self.late + self.outdated else ""
        return counts + _ANOTHER_ONE

    # The refusal may arrive before the state that explains it.
    def _check_joint(self):
        conversation = self._conversation
        seen = conversation.messages
        conversation.network.wait_until(
            lambda: conversation.state.mode == Mode.FAULTED or self._restarted() or conversation.messages > seen + 1, OLD_STATES_S)
        self._check_state(conversation.state.cycle)

    # In states before `from_cycle`, a yield may be older than the stream.
    def _check_state(self, from_cycle):
        self._check_restart()
        state = self._conversation.state
        if state.mode == Mode.FAULTED:
            self._lose()
            raise faulted(self._conversation)
        if has_yielded(state) and state.cycle >= from_cycle:
            self._lose()
            raise yielded(self._conversation, "did not follow the stream to its end")

    # Each daemon counts its own cycles, so the samples' cycles have no meaning for a restarted one.
    def _restarted(self):
        return self._conversation.state.session_id != self._session_id

    def _check_restart(self):
        if self._restarted():
            self._lose()
            raise NotDone(f"{self._joint.name}: did not follow the stream to its end: the daemon was restarted, and the joint is "
                          f"{Mode(self._conversation.state.mode)}; enable it; Joint.stream() opens a new stream")

    # The stream has lost the joint to the client or the event that ended it, so it sends no hold.
    def _lose(self):
        self._over, self._last_cycle = True, None

    def _leave_out(self, cycle):
        self.late += 1
        if (cycle - self._last_cycle) * self._period_s > self._valid_for_s:
            raise NotDone(f"{self._joint.name}: stream timed out after {self.late} late samples "
                          f"(valid_for_s = {self._valid_for_s} s). Send samples earlier, or give a larger ahead_s; Joint.stream() opens a new stream")
        return False
