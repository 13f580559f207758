"""Waiting for a motion's end. Source: client/commands/motion_commands.cc, of which this is the same in Python."""
import dataclasses

from .errors import Faulted, NoAnswer, NotDone
from .network import now_s
from .state import State
from .vocabulary import Mode

OLD_STATES_S = 0.2  # a state that left the daemon before it took the order may arrive after the acknowledgement
_LOOK_S = 0.01
_STAY_S = 0.1


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

    def reached(self, state):
        """True once the joint has been inside for long enough. Raises NotDone when it holds outside."""
        error_rad = self._target_rad - state.joint_position_rad
        if not abs(error_rad) <= self._tolerance_rad:
            self._inside_s = None
        elif self._inside_s is None:
            self._inside_s = state.received_s
        if state.mode != Mode.HOLDING:
            self._holding_s = None
            return False
        if self._holding_s is None:
            self._holding_s = now_s()
        if self._inside_s is not None and now_s() - self._inside_s >= _STAY_S:
            self.arrival = Arrival(max(0.0, self._inside_s - self._start_s), error_rad)
            return True
        if now_s() - self._holding_s > self._patience_s:
            raise NotDone(f"{self._joint}: holds {error_rad:.2e} rad away from {self._target_rad:g} rad, outside of tolerance_rad "
                          f"{self._tolerance_rad:g}")
        return False


def _why_ended(state, session_id, replaced):
    if state.session_id != session_id:
        return "the daemon was restarted"
    if state.mode in (Mode.OFF, Mode.STOPPING):
        return "the joint was disabled"
    return "another order replaced this one" if replaced(state) else ""


def wait_for_motion(conversation, mode, purpose, done, replaced=lambda state: False):
    """Waits for done(State). `mode`: while the motion lasts; `purpose`: in words, after "did not". Raises Faulted, NotDone, NoAnswer."""
    session_id = conversation.state.session_id
    old_states_end_s = now_s() + OLD_STATES_S
    motion_seen = False
    while True:
        seen = conversation.messages
        conversation.network.wait_until(lambda: conversation.messages != seen, _LOOK_S)
        if now_s() - conversation.received_s > conversation.timeout_s:
            raise NoAnswer(f"{conversation.joint}: the daemon fell silent during the motion; the joint's state is not known")
        state = State(conversation.state, conversation.received_s)
        if state.mode == Mode.FAULTED:
            raise Faulted(conversation.joint, state.fault, state.fault_words())
        motion_seen = motion_seen or state.mode == mode
        if not motion_seen and now_s() < old_states_end_s:
            continue
        why = _why_ended(state, session_id, replaced)
        if why:
            raise NotDone(f"{conversation.joint}: did not {purpose}: {why}")
        if done(state):
            return
