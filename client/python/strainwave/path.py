# SPDX-License-Identifier: BSD-3-Clause
"""A path: a motion of one or several joints of a daemon. The daemon checks it before it begins. docs/streams.md, "Paths"."""
import math
from collections.abc import Iterable, Mapping, Sized

from .errors import InvalidInput, NotDone, shown
from .joint import Joint
from .messages import blank
from .motion import OLD_STATES_S, ArrivalWatch, MotionWatch, degrees_hint, wait_for_motions
from .network import now_s
from .path_v1 import path_v1
from .stream import check_number
from .vocabulary import Action, Mode, Notice

MOST_KNOTS = 320
_FIELDS = ("time_s", "position_rad", "velocity_rad_s")  # of a knot


class Path:
    """knots: {joint: [(time_s, position_rad, velocity_rad_s), ...]} with 2 to 320 knots for each Joint; the first at time 0, the first and the
    last with velocity 0. Between them the path is cubic. Nothing moves before start().
    """

    def __init__(self, knots):
        if not isinstance(knots, Mapping):
            raise InvalidInput(f"{shown(knots)}: {{joint: [(time_s, position_rad, velocity_rad_s), ...]}} is allowed")
        if not knots:
            raise InvalidInput("a path needs at least one joint")
        for joint in knots:
            if not isinstance(joint, Joint):
                raise InvalidInput(f"{shown(joint)}: a Joint is allowed, as Joint({shown(joint)})")
        for joint in knots:
            joint._conversation.require_same_daemon(next(iter(knots))._conversation, "the joints of a path")
        names = [joint.name for joint in knots]
        for name in names:
            if names.count(name) > 1:
                raise InvalidInput(f"{name}: {names.count(name)} Joints of that name have knots: one is allowed, with all of its knots")
        self._knots = {joint: self._checked(joint.name, of_joint) for joint, of_joint in knots.items()}
        self._joints = list(self._knots)
        self._started = False

    def start(self):
        """All joints begin in one cycle, or none: each must hold within 1 mrad of its first knot. Raises Refused, which names knot and limit
        when the path exceeds a limit of a joint, NoAnswer, InvalidInput.
        """
        path_id = self._joints[0]._conversation.sender.next_sequence()
        for joint, knots in self._knots.items():
            message = blank(path_v1)
            message.path_id, message.joint_count, message.knot_count = path_id, len(self._knots), len(knots)
            padding = [0.0] * (MOST_KNOTS - len(knots))
            message.time_s = [knot[0] for knot in knots] + padding
            message.position_rad = [knot[1] for knot in knots] + padding
            message.velocity_rad_s = [knot[2] for knot in knots] + padding
            farthest_rad = max((knot[1] for knot in knots), key=abs)
            joint._conversation.request("PATH", message, "its part of the path", hint=degrees_hint(farthest_rad))
        self.resume()
        self._started = True

    def pause(self):
        """Stops on the path, with all joints, as quickly as their accelerations allow."""
        self._joints[0]._order(Action.PAUSE)

    def resume(self):
        """Continues after a pause."""
        self._joints[0]._order(Action.RESUME)

    def hold(self):
        """Ends the path: each joint stops within its own limits, off the path. Returns once they hold. Needs no key."""
        for joint in self._joints:
            joint.hold()

    def wait(self, tolerance_rad=1e-3, timeout_s=None):
        """Returns once every joint is within `tolerance_rad` of its last knot and stays there: {joint: Arrival}, timed from now. The wait goes
        on during a pause: see Notice.PATH_PAUSED and path_time_s of the state. Raises Faulted and NoAnswer. Raises NotDone after `timeout_s`,
        with the place on the path and whether it is paused, or when the path ended otherwise. It may also wait for a path that another program
        has started. If this path is not under way, it soon raises NotDone, even if the joints are at its end.
        """
        tolerance_rad = check_number("tolerance_rad", tolerance_rad, "a number above 0", lambda rad: rad > 0)
        if timeout_s is not None:
            timeout_s = check_number("timeout_s", timeout_s, "None or a number above 0", lambda seconds: seconds > 0)
        if not self._started:
            self._check_under_way()
        begin_s = now_s()

        def look():
            if timeout_s is not None and now_s() - begin_s > timeout_s:
                raise NotDone(f"{self._joints[0].name}: the path did not arrive in {timeout_s:g} s: {self._where()}")

        arrivals = {joint: ArrivalWatch(joint.name, knots[-1][1], tolerance_rad, joint._timeout_s) for joint, knots in self._knots.items()}
        wait_for_motions([self._motion(joint, knots[-1][1], arrivals[joint]) for joint, knots in self._knots.items()], look)
        return {joint: watch.arrival for joint, watch in arrivals.items()}

    def _joint_elsewhere(self):
        """The first joint that is not on its way to the end of this path; None: the path is under way."""
        # Joints at rest at the end may have arrived there by another motion.
        ends = [(joint, joint._conversation.state, knots[-1][1]) for joint, knots in self._knots.items()]
        elsewhere = [joint for joint, state, end_rad in ends if state.target_position_rad != end_rad]
        moving = any(state.mode == Mode.TRACKING or not math.isnan(state.path_time_s) for _, state, _ in ends)
        return elsewhere[0] if elsewhere else None if moving else self._joints[0]

    def _check_under_way(self):
        for joint in self._joints:
            joint._conversation.wait_for_state()
        if not self._joints[0]._wait_until(lambda: self._joint_elsewhere() is None, OLD_STATES_S):
            joint = self._joint_elsewhere() or self._joints[0]
            raise NotDone(f"{joint.name}: is not on its way to {self._knots[joint][-1][1]:g} rad: this path is not under way; start() begins it")

    def _where(self):
        state = self._joints[0].state
        if math.isnan(state.path_time_s):
            return "its joints are on their way to its end"
        of_s = max(knots[-1][0] for knots in self._knots.values())
        return f"it is {'paused ' if state.notices & Notice.PATH_PAUSED else ''}at {state.path_time_s:.3f} s of {of_s:.3f} s"

    @staticmethod
    def _motion(joint, end_rad, watch):
        joint._conversation.wait_for_state()
        return MotionWatch(joint._conversation, Mode.TRACKING, f"arrive at {end_rad:g} rad", watch.reached,
                           lambda state: state.target_position_rad != end_rad, watch.observe)

    @staticmethod
    def _checked(name, knots):
        if not isinstance(knots, Iterable):
            raise InvalidInput(f"{name}: {shown(knots)}: a list of knots (time_s, position_rad, velocity_rad_s) is allowed")
        knots = list(knots)
        if not 2 <= len(knots) <= MOST_KNOTS:
            raise InvalidInput(f"{name}: {len(knots)} knot{'' if len(knots) == 1 else 's'}: 2 to {MOST_KNOTS} are allowed")
        for index, knot in enumerate(knots):
            if not isinstance(knot, Sized) or len(knot) != 3:
                raise InvalidInput(f"{name}: knot {index} = {shown(knot)}: (time_s, position_rad, velocity_rad_s) is allowed")
        return [tuple(check_number(field, number, "a finite number", lambda _: True, f"{name}: knot {index}")
                      for field, number in zip(_FIELDS, knot)) for index, knot in enumerate(knots)]
