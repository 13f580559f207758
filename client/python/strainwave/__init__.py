# SPDX-License-Identifier: BSD-3-Clause
"""Strainwave's joints from Python: orders that are signed, acknowledged and repeated, streams of setpoints, states with names.

    joint = Joint("elbow", key="~/.strainwave-key")       # and enable(), move(0.5), hold(), disable(), home(), state, limits, states()
    path = Path({joint: [(0, 0, 0), (1, 0.4, 0)]})        # knots (time_s, position_rad, velocity_rad_s); start(), wait(), pause(), resume()
    with joint.stream() as stream:                        # a Stream: put() again and again, close() at its end
        stream.put(t, position_rad, velocity_rad_s)

All that fails is a StrainwaveError: InvalidInput (refused here), NoAnswer (silence), Refused (by the daemon, with its reason), Faulted,
NotDone (accepted, but it did not come to its end) and Yielded (a NotDone: to a load). Each says what was given, what is allowed and what to do.

Pure Python; signing needs libsodium. docs/client.md has examples, docs/messages.md every field. The message types (state_v1, ...) are
those that lcm-gen makes, for programs that speak LCM themselves.
"""
# The types first: they look for each other here.
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
