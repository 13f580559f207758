# SPDX-License-Identifier: BSD-3-Clause
"""Waiting for a motion's end. Source: client/commands/motion_commands.cc, of which this is the same in Python."""
import dataclasses
import math

from .errors import Faulted, NoAnswer, NotDone, Yielded
from .network import now_s
from .state import State
from .vocabulary import Mode, Notice

OLD_STATES_S = 0.2  # a state that left the daemon before it took the order may arrive after the acknowledgement
LONGEST_PATH_S = 3600.0  # kLongestPath_s of the daemon
_LOOK_S = 0.01
_SAME_CYCLE_S = 0.05  # between the states of a cycle
_STAY_S = 0.1
_MOMENT_S = 0.3


def degrees_hint(position_rad):
    """What to say of a position that was refused and may be meant in degrees; empty when it cannot be."""
    if abs(position_rad) <= 2 * math.pi:
        return ""
    return f"positions are in rad: {position_rad:g} degrees would be {math.radians(position_rad):.6g}"


def error_text(error_rad, tolerance_rad):
    """"-9.90e-04": an error, with as many more digits as tell on which side of `tolerance_rad` it is."""
    texts = (f"{error_rad:.{digits}e}" for digits in range(2, 17))
    return next(text for text in texts if (abs(float(text)) <= tolerance_rad) == (abs(error_rad) <= tolerance_rad))


@dataclasses.dataclass(frozen=True)
class Arrival:
    """How a move ended: from the order to when the joint was inside the tolerance for good, and target minus position."""

    duration_s: float
    error_rad: float


class ArrivalWatch:
    """Inside a tolerance of a target, and staying there."""

    def __init__(self, joint, target_rad, tolerance_rad, patience_s):
        self._joint, self._target_rad, self._tolerance_rad, self._patience_s = joint, target_rad, tolerance_rad, patience_s
        self._start_s = now_s()
        self._inside_s = self._holding_s = None
        self.arrival = None

    def observe(self, state):
        """From when on it is inside. A short motion may be over before it is known to be this order's."""
        if not abs(self._target_rad - state.joint_position_rad) <= self._tolerance_rad:
            self._inside_s = None
        elif self._inside_s is None:
            self._inside_s = state.received_s

    def reached(self, state):
        """True once the joint has been inside for long enough. Raises NotDone when it holds outside."""
        error_rad = self._target_rad - state.joint_position_rad
        if state.mode != Mode.HOLDING:
            self._holding_s = None
            return False
        if self._holding_s is None:
            self._holding_s = now_s()
        if self._inside_s is not None and now_s() - self._inside_s >= _STAY_S:
            self.arrival = Arrival(max(0.0, self._inside_s - self._start_s), error_rad)
            return True
        if now_s() - self._holding_s > self._patience_s:
            raise NotDone(f"{self._joint}: holds {error_text(error_rad, self._tolerance_rad)} rad away from {self._target_rad:g} rad, outside of "
                          f"tolerance_rad {self._tolerance_rad!r}")
        return False


def faulted(conversation):
    """The Faulted of a joint that is."""
    state = State(conversation.state, conversation.received_s)
    return Faulted(conversation.joint, state.fault, state.fault_words())


def yielded(conversation, undone):
    """The Yielded of a joint that has, since it was last set moving. undone: what came of it, in words."""
    state = State(conversation.state, conversation.received_s)
    now = f"it holds at {state.joint_position_rad:.4g} rad" if state.mode == Mode.HOLDING else f"it is {state.mode}"
    return Yielded(conversation.joint, f"{undone}: it yielded to a load of {abs(state.yield_load_Nm):.4g} N.m (load_Nm allows "
                   f"{state.yield_limit_Nm:g}) at {state.yield_position_rad:.4g} rad; {now}",
                   state.yield_load_Nm, state.yield_limit_Nm, state.yield_position_rad)


def has_yielded(state):
    """Of a state_v1, or a State."""
    return bool(state.notices & Notice.YIELDED)


def _why_ended(state, session_id, replaced):
    if state.session_id != session_id:
        return "the daemon was restarted"
    if state.mode in (Mode.OFF, Mode.STOPPING):
        return "the joint was disabled"
    return "another command replaced this one" if replaced and replaced(state) else ""


class MotionWatch:
    """A joint's motion, looked at again and again once its order is in force.

    mode: while the motion lasts; purpose: in words, after "did not"; done(State): whether it came to its end
    replaced(State): whether another order of its kind did; None: cannot be
    observe(State): called with every state that shows this order's target, though it may be from before it
    """

    def __init__(self, conversation, mode, purpose, done, replaced=None, observe=lambda state: None):
        self.conversation, self._observe = conversation, observe
        self._mode, self._purpose, self._done, self._replaced = mode, purpose, done, replaced
        self._session_id = conversation.state.session_id
        self._old_states_end_s = now_s() + OLD_STATES_S
        self._seen = False

    def stop(self):
        """The Faulted of a joint that is, or the Yielded of one that has in this motion; else None."""
        state = self.conversation.state
        if state.mode == Mode.FAULTED:
            return faulted(self.conversation)
        if self._replaced is not None and self._in_force(state) and has_yielded(state):
            return yielded(self.conversation, f"did not {self._purpose}")
        return None

    def _in_force(self, state):
        # Whether the state is of this motion, or of what came after it.
        self._seen = self._seen or state.mode == self._mode and not (self._replaced and self._replaced(state))
        return self._seen or now_s() >= self._old_states_end_s

    def look(self):
        """True once it is done. Raises NotDone, NoAnswer when it ended otherwise."""
        joint, conversation = self.conversation.joint, self.conversation
        if now_s() - conversation.received_s > conversation.timeout_s:
            raise NoAnswer(f"{joint}: lost contact with strainwaved during the motion: {conversation.silence()}; the joint may still be moving")
        state = State(conversation.state, conversation.received_s)
        if self._replaced is not None and not self._replaced(state):
            self._observe(state)
        if not self._in_force(state):
            return False
        why = _why_ended(state, self._session_id, self._replaced)
        if why:
            raise NotDone(f"{joint}: did not {self._purpose}: {why}")
        return self._done(state)


def _stops(motions):
    stops = [stop for motion in motions if (stop := motion.stop()) is not None]
    return sorted(stops, key=lambda stop: not isinstance(stop, Faulted))


def _check_stops(motions):
    # What stopped any of them is told with what stopped others: once all have come to rest, or the first one's patience ends; and where
    # others only stopped with it, a moment after that: who drove into something, too, may show it then.
    if not _stops(motions):
        return
    first = motions[0].conversation
    first.network.wait_until(lambda: all(motion.conversation.state.mode != Mode.TRACKING for motion in motions), first.timeout_s)
    first.network.wait_until(lambda: len(_stops(motions)) == len(motions), _MOMENT_S)
    each = _stops(motions)
    if len(each) == 1:
        raise each[0]
    for error in _stops(motions)[:1]:
        error.each, error.args = tuple(each), ("\n".join(map(str, each)),)
        raise error


def wait_for_motions(motions, look=lambda: None):
    """Returns once all of them are done. Raises Faulted or Yielded of one of them before it asks why those that move with it ended.
    look() is called again and again meanwhile, and may raise.
    """
    under_way = list(motions)
    while under_way:
        first = under_way[0].conversation
        seen = first.messages
        first.network.wait_until(lambda: first.messages != seen, _LOOK_S)
        # States of one cycle come one after the other.
        first.network.wait_until(lambda: all(motion.conversation.state.cycle >= first.state.cycle for motion in under_way), _SAME_CYCLE_S)
        _check_stops(under_way)
        under_way = [motion for motion in under_way if not motion.look()]
        if under_way:
            look()


def wait_for_motion(*motion):
    """The same of one, of MotionWatch's arguments."""
    wait_for_motions([MotionWatch(*motion)])
