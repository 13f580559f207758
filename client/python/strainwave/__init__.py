# SPDX-License-Identifier: BSD-3-Clause
"""Strainwave's joints from Python: signed orders that are repeated until they are acknowledged, streams of setpoints, named states.

    joint = Joint("elbow", key="~/.strainwave-key")       # and enable(), move(0.5), hold(), disable(), home(), state, limits, states()
    path = Path({joint: [(0, 0, 0), (1, 0.4, 0)]})        # knots (time_s, position_rad, velocity_rad_s); start(), wait(), pause(), resume()
    with joint.stream() as stream:                        # a Stream: put() again and again, close() at its end
        stream.put(t, position_rad, velocity_rad_s)

Every error is a StrainwaveError: InvalidInput (refused here), NoAnswer (silence), Refused (by the daemon, with its reason), Faulted,
NotDone (accepted, but not completed) and Yielded (a NotDone: the joint yielded to a load). Each names the value, the allowed range and the remedy.

Pure Python; signing needs libsodium. docs/client.md has examples, docs/messages.md every field. lcm-gen makes the
message types (state_v1, ...), for programs that use LCM directly.
"""
# The types come first, because they import each other from this package.
from .ack_v1 import ack_v1
from .command_v1 import command_v1
from .box_cell_v1 import box_cell_v1
from .feedback_gains_v1 import feedback_gains_v1
from .gain_table_v1 import gain_table_v1
from .inject_v1 import inject_v1
from .limits_v1 import limits_v1
from .path_v1 import path_v1
from .setpoint_v1 import setpoint_v1
from .state_v1 import state_v1
from .temperature_v1 import temperature_v1
from .timing_v1 import timing_v1

from .errors import Faulted, InvalidInput, NoAnswer, NotDone, Refused, StrainwaveError, Yielded
from .joint import Joint
from .motion import Arrival
from .path import Path
from .state import Limits, State
from .stream import Stream
from .vocabulary import Action, Fault, Mode, Notice, Reason, TemperatureStatus

__all__ = ["Joint", "Path", "Stream", "Arrival", "State", "Limits",
           "StrainwaveError", "InvalidInput", "NoAnswer", "Refused", "Faulted", "NotDone", "Yielded",
           "Mode", "Fault", "Reason", "Notice", "Action", "TemperatureStatus",
           "ack_v1", "box_cell_v1", "command_v1", "feedback_gains_v1", "gain_table_v1", "inject_v1", "limits_v1", "path_v1", "setpoint_v1",
           "state_v1", "temperature_v1", "timing_v1"]
