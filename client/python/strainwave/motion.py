# SPDX-License-Identifier: BSD-3-Clause
"""Waits for the end of a motion. Source: the same in C++ is client/protocol/motion.cc."""
import dataclasses
import math

from .errors import Faulted, NoAnswer, NotDone, Yielded
from .network import now_s
from .state import State
from .vocabulary import Mode, Notice

OLD_STATES_S = 0.2  # a state that the daemon sent before it took the order may arrive after the acknowledgement
LONGEST_PATH_S = 3600.0  # kLongestPath_s of the daemon
_LOOK_S = 0.01
_SAME_CYCLE_S = 0.05  # longest wait for the other states of a cycle
_STAY_S = 0.1
_MOMENT_S = 0.3


def degrees_hint(position_rad):
    """A hint for a refused position that may be meant in degrees; empty if it cannot be."""
    if abs(position_rad) <= 2 * math.pi:
        return ""
    return f"positions are in rad: {position_rad:g} degrees would be {math.radians(position_rad):.6g}"


def error_text(error_rad, tolerance_rad):
    """"-9.90e-04": an error, with enough digits to show on which side of `tolerance_rad` it lies."""
    texts = (f"{error_rad:.{digits}e}" for digits in range(2, 17))
    return next(text for text in texts if (abs(float(text)) <= tolerance_rad) == (abs(error_rad) <= tolerance_rad))


@dataclasses.dataclass(frozen=True)
class Arrival:
    """The end of a move: the time from the order until the joint stayed inside the tolerance, and target minus position."""

    duration_s: float
    error_rad: float


class ArrivalWatch:
    """Watches whether a joint is inside the tolerance of its target and stays there."""

    def __init__(self, joint, target_rad, tolerance_rad, patience_s):
        self._joint, self._target_rad, self._tolerance_rad, self._patience_s = joint, target_rad, tolerance_rad, patience_s
        self._start_s = now_s()
        self._inside_s = self._holding_s = None
        self.arrival = None

    def observe(self, state):
        """Notes the time at which the joint got inside. A short motion may end before its order is known to be in force."""
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
    """The Faulted error for a joint with a fault."""
    state = State(conversation.state, conversation.received_s)
    return Faulted(conversation.joint, state.fault, state.fault_words())


def yielded(conversation, undone):
    """The Yielded error for a joint that has yielded since its last start of motion. undone: the failed action, in words."""
    state = State(conversation.state, conversation.received_s)
    now = f"it holds at {state.joint_position_rad:.4g} rad" if state.mode == Mode.HOLDING else f"it is {state.mode}"
    return Yielded(conversation.joint, f"{undone}: it yielded to a load of {abs(state.yield_load_Nm):.4g} N.m (load_Nm allows "
                   f"{state.yield_limit_Nm:g}) at {state.yield_position_rad:.4g} rad; {now}",
                   state.yield_load_Nm, state.yield_limit_Nm, state.yield_position_rad)


def has_yielded(state):
    """Whether a state_v1 or a State shows that the joint has yielded to a load."""
    return bool(state.notices & Notice.YIELDED)


def _why_ended(state, session_id, replaced):
    if state.session_id != session_id:
        return "the daemon was restarted"
    if state.mode in (Mode.OFF, Mode.STOPPING):
        return "the joint was disabled"
    return "another command replaced this one" if replaced and replaced(state) else ""


class MotionWatch:
    """Watches a joint's motion once its order is in force.

    mode: while the motion lasts; purpose: in words, after "did not"; done(State): whether it has ended as ordered
    replaced(State): whether another order of its kind replaced it; None: impossible
    observe(State): called with every state that shows this order's target; the state may be older than the order
    """

    def __init__(self, conversation, mode, purpose, done, replaced=None, observe=lambda state: None):
        self.conversation, self._observe = conversation, observe
        self._mode, self._purpose, self._done, self._replaced = mode, purpose, done, replaced
        self._session_id = conversation.state.session_id
        self._old_states_end_s = now_s() + OLD_STATES_S
        self._seen = False

    def stop(self):
        """The Faulted error if the joint has a fault, the Yielded error if it has yielded in this motion, else None."""
        state = self.conversation.state
        if state.mode == Mode.FAULTED:
            return faulted(self.conversation)
        if self._replaced is not None and self._in_force(state) and has_yielded(state):
            return yielded(self.conversation, f"did not {self._purpose}")
        return None

    def _in_force(self, state):
        # Whether the state shows this motion or a later one.
        self._seen = self._seen or state.mode == self._mode and not (self._replaced and self._replaced(state))
        return self._seen or now_s() >= self._old_states_end_s

    def look(self):
        """Returns True once the motion is done. Raises NotDone if it ended otherwise, NoAnswer if the joint is silent."""
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
    # If a fault or a load stopped any joint, raises an error that names every such joint. First it waits until all rest, at most one time-out.
    # Then it waits a moment more, because a joint that stopped with the others may also show a fault or a yield.
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
    """Returns once all motions are done. Raises Faulted or Yielded before it reports the effects on the joints that move along.
    look() is called repeatedly during the wait, and may raise.
    """
    under_way = list(motions)
    while under_way:
        first = under_way[0].conversation
        seen = first.messages
        first.network.wait_until(lambda: first.messages != seen, _LOOK_S)
        # The states of one cycle arrive one by one.
        first.network.wait_until(lambda: all(motion.conversation.state.cycle >= first.state.cycle for motion in under_way), _SAME_CYCLE_S)
        _check_stops(under_way)
        under_way = [motion for motion in under_way if not motion.look()]
        if under_way:
            look()


def wait_for_motion(*motion):
    """The same for one motion, with the arguments of MotionWatch."""
    wait_for_motions([MotionWatch(*motion)])
