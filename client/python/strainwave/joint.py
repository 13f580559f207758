# SPDX-License-Identifier: BSD-3-Clause
"""A joint of a Strainwave daemon."""
import math
import os

from .command_v1 import command_v1
from .conversation import Conversation
from .errors import InvalidInput, NoAnswer, NotDone
from .messages import blank
from .motion import LONGEST_PATH_S, OLD_STATES_S, Arrival, ArrivalWatch, degrees_hint, faulted, wait_for_motion
from .network import Network, check_name, now_s
from .sender import Sender
from .setpoint_v1 import setpoint_v1
from .state import Limits, State
from .stream import Stream, check_number
from .vocabulary import Action, Mode, Notice

_ENABLED = (Mode.HOLDING, Mode.TRACKING, Mode.HOMING)


class Joint:
    """Gives orders to one joint and reads its state. Positions, velocities and torques are on the joint side, in SI units.

    name: name of the joint in the daemon's configuration; prefix: prefix of the daemon
    key: file of the secret key (strainwavectl keygen); None: the file that STRAINWAVE_KEY names; "" or neither: orders go out unsigned
    lcm_url: None: the value of LCM_DEFAULT_URL, or else the default URL of LCM on this machine
    timeout_s: of each wait: for a state, for an acknowledgement, for a change of mode; 0.1 to 3600
    """

    def __init__(self, name, key=None, *, prefix="SW", lcm_url=None, timeout_s=2.0):
        self.name = check_name("name", name)
        self._timeout_s = check_number("timeout_s", timeout_s, "0.1 to 3600", lambda s: 0.1 <= s <= 3600, name)
        sender = Sender(os.environ.get("STRAINWAVE_KEY") if key is None else key)
        self._conversation = Conversation(Network.shared(lcm_url), check_name("prefix", prefix), name, sender, self._timeout_s)
        self._wait_until = self._conversation.network.wait_until

    @property
    def state(self):
        """The latest State; waits for the first. Raises NoAnswer, also when the joint has become silent."""
        message = self._conversation.heard_state()
        return State(message, self._conversation.received_s)

    @property
    def limits(self):
        """Limits of the joint, constant while the daemon runs; waits for the first."""
        self._conversation.wait_for_state()
        if not self._wait_until(lambda: self._conversation.limits is not None, max(self._timeout_s, 2.0)):
            silence = self._conversation.silence()
            raise NoAnswer(f"{self.name}: " + (f"its limits are not known: {silence}" if silence else "publishes its state but not its limits"))
        return Limits(self._conversation.limits, self._conversation.received_s)

    def states(self, duration_s=math.inf):
        """Yields every received State in order, for `duration_s`. A caller that is too slow sees gaps in `cycle`. Raises NoAnswer,
        InvalidInput.
        """
        if duration_s != math.inf:
            duration_s = check_number("duration_s", duration_s, "0 or above", lambda s: s >= 0, self.name)
        return self._states(duration_s)

    def _states(self, duration_s):
        inbox = self._conversation.open_inbox()
        end_s = None
        try:
            while True:
                if not self._wait_until(lambda: inbox, self._timeout_s):
                    self._conversation.wait_for_state()  # its error is more specific if no state ever came
                    raise self._conversation.fell_silent("lost contact with strainwaved")
                message, received_s = inbox.popleft()
                end_s = received_s + duration_s if end_s is None else end_s
                if received_s > end_s:
                    return
                yield State(message, received_s)
        finally:
            self._conversation.close_inbox(inbox)

    def enable(self):
        """Switches the drive on; returns once the joint holds. If it is enabled already, nothing is sent and there is no error."""
        self._conversation.heard_state()
        state = self._conversation.deciding_state()
        if state.mode not in _ENABLED:
            self._order(Action.ENABLE, state)
        ordered_s = now_s()

        def decided():
            mode = self._mode()
            if mode == Mode.FAULTED:
                raise faulted(self._conversation)
            if mode == Mode.OFF and now_s() > ordered_s + OLD_STATES_S:
                raise NotDone(f"{self.name}: went back to off while it was starting; see the daemon's log")
            return mode in _ENABLED

        self._wait_for(decided)

    def disable(self):
        """Stops the joint and switches the drive off; returns once it is off. Needs no key. It is repeated until it is acknowledged."""
        self._stop(Action.DISABLE)

        def decided():
            if self._mode() == Mode.FAULTED:
                raise faulted(self._conversation)
            return self._mode() == Mode.OFF

        self._conversation.wait_for_state()
        self._wait_for(decided)

    def hold(self):
        """Stops the joint where it comes to rest; returns once it holds. Needs no key. It is repeated until it is acknowledged."""
        self._stop(Action.HOLD)
        self._conversation.wait_for_state()
        wait_for_motion(self._conversation, Mode.TRACKING, "hold", lambda state: state.mode == Mode.HOLDING)

    def clear_fault(self):
        """Clears a latched fault; the joint is off then. For a joint without a fault, nothing is sent."""
        self._conversation.heard_state()
        state = self._conversation.deciding_state()
        if state.mode == Mode.FAULTED:
            self._order(Action.CLEAR_FAULT, state)
            self._wait_for(lambda: self._mode() != Mode.FAULTED)

    def home(self):
        """Finds the home position; returns once the joint holds there."""
        self._order(Action.HOME)
        wait_for_motion(self._conversation, Mode.HOMING, "find home", lambda state: state.mode == Mode.HOLDING)
        if self.state.notices & Notice.NOT_HOMED:
            raise NotDone(f"{self.name}: homing was stopped before it found home")

    def take_over(self):
        """Makes this user the owner of the joint, even if another client owns it. Needs the role engineer."""
        self._order(Action.TAKE_OVER)

    def release(self):
        """Gives up the ownership of the joint before its lease ends. The joint has no owner then."""
        self._order(Action.RELEASE)

    def reset_learning(self):
        """Forgets the learned friction and load: the joint uses the friction of its table. The joint must hold or be off."""
        self._order(Action.RESET_LEARNING)

    def freeze_learning(self):
        """Keeps the learned values in use without further change, until resume_learning() or a restart of the daemon."""
        self._order(Action.FREEZE_LEARNING)

    def resume_learning(self):
        """Lets the joint learn again."""
        self._order(Action.RESUME_LEARNING)

    def move(self, position_rad, *, speed_limit_rad_s=0.0, tolerance_rad=1e-3, wait=True) -> Arrival | None:
        """Moves to `position_rad`, no faster than `speed_limit_rad_s` (0: the default share of the joint's limit).

        With `wait`, returns an Arrival once the joint is within `tolerance_rad` and stays there. Without, returns at once, while the
        joint moves. An exception of the wait, such as a keyboard interrupt, does not end the motion: hold() does. Raises Refused, Faulted,
        NotDone, NoAnswer, InvalidInput.
        """
        position_rad = check_number("position_rad", position_rad, "a finite number of rad", lambda _: True, self.name)
        tolerance_rad = check_number("tolerance_rad", tolerance_rad, "a number above 0", lambda rad: rad > 0, self.name)
        message = blank(setpoint_v1)
        message.position_rad = position_rad
        message.speed_limit_rad_s = self._speed_limit(speed_limit_rad_s)
        message.acknowledge = 1
        state = self._conversation.deciding_state()
        self._check_quick_enough(state, position_rad, message.speed_limit_rad_s)
        self._conversation.request("SETPOINT", message, f"move to {position_rad:g} rad", hint=degrees_hint(position_rad), state=state)
        if not wait:
            return None
        watch = ArrivalWatch(self.name, position_rad, tolerance_rad, self._timeout_s)
        wait_for_motion(self._conversation, Mode.TRACKING, f"arrive at {position_rad:g} rad", watch.reached,
                        lambda state: state.target_position_rad != position_rad, watch.observe)
        return watch.arrival

    def stream(self, *, ahead_s=0.1, valid_for_s=2.0, speed_limit_rad_s=0.0, approach=False, beside=None):
        """A Stream of setpoints, for a with-statement. Nothing moves before its first put().

        ahead_s: how long before its time a sample is sent; the network and this program may be late by this time
        valid_for_s: the stream ends when no sample comes for this time; the joint comes to rest before that
        approach: True: if the stream begins far from the joint, the joint approaches it at the speed of a move; False: the daemon refuses it
        beside: the Stream of another joint of this daemon; the same t is then the same cycle in both
        """
        return Stream(self, self._conversation, self.limits.period_s, ahead_s, valid_for_s, self._speed_limit(speed_limit_rad_s), approach,
                      beside)

    def _speed_limit(self, speed_limit_rad_s):
        return check_number("speed_limit_rad_s", speed_limit_rad_s, "0 (none) or above", lambda speed: speed >= 0, self.name)

    def _check_quick_enough(self, state, position_rad, speed_rad_s):
        # A move of more than an hour is probably a mistake, and no path may take longer either.
        way_rad = abs(position_rad - state.setpoint_position_rad)
        if speed_rad_s == 0 or way_rad <= speed_rad_s * LONGEST_PATH_S:
            return
        least = f"{1.01 * way_rad / LONGEST_PATH_S:.3g}"  # one percent more, for rounding in the message
        hint = degrees_hint(position_rad)
        raise InvalidInput(f"{self.name}: speed_limit_rad_s = {speed_rad_s!r}: at least {least} is allowed: the way of {way_rad:.3g} rad takes "
                           f"{way_rad / speed_rad_s:.3g} s at that speed, and a move takes at most {LONGEST_PATH_S:g} s"
                           + (f"; {hint}" if hint else ""))

    def _mode(self):
        return Mode(self._conversation.state.mode)

    def _order(self, action, state=None):
        message = blank(command_v1)
        message.action = int(action)
        self._conversation.request("COMMAND", message, action.text, state=state)

    def _stop(self, action):
        message = blank(command_v1)
        message.action = int(action)
        self._conversation.request_stop("COMMAND", message, action.text)

    def _wait_for(self, decided):
        if not self._wait_until(decided, self._timeout_s):
            mode, silence = self._mode().text, self._conversation.silence()
            end = f"then {silence}; the last mode was {mode}" if silence else f"but the joint is still {mode} after {self._timeout_s:g} s"
            raise NoAnswer(f"{self.name}: the order was accepted, {end}")
