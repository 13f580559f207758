// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/refusal_advice.h"

#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "base/printable.h"

namespace strainwave {

namespace {

// Significant digits of measured values.
constexpr int kShownDigits = 4;

bool is_of_path(OrderKind kind) {
  return kind == OrderKind::kLoadPath || kind == OrderKind::kPausePath || kind == OrderKind::kResumePath;
}

// The likely mistake behind `ratio`, the velocity over the rate of the positions; empty if unknown.
std::string_view unit_of_velocity(double ratio) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr double kNear = 0.05;  // tolerance for samples of uneven motion
  if (std::abs(ratio / kDegrees - 1.0) < kNear) return ", as if in deg/s";
  return std::abs(ratio + 1.0) < kNear ? ", as if with the opposite sign" : "";
}

// Text of a refusal by a number: the number, what is allowed, and where that is set.
std::string number_refused(const Reply& reply, OrderKind kind) {
  std::ostringstream text;
  const std::string value = beyond_text(reply.value, reply.limit);
  const std::string limit = bound_text(reply.limit);
  if (is_of_path(kind)) {
    if (reply.reason == Reason::kWrongMode)
      text << ": the daemon has the path's parts for " << reply.value << " of its " << reply.limit
           << " joints: send the others (PATH), then resume";
    else
      text << ": the path begins " << value << " rad from the target of "
           << (kind == OrderKind::kLoadPath ? "the joint" : "one of its joints") << "; at most " << limit
           << " rad are allowed: move to the first knot first";
    return text.str();
  }
  if (reply.reason == Reason::kMoving)
    text << " and moves at " << value << " rad/s: enable needs standstill, at most " << limit
         << " rad/s (joint.supervision.standstill_rad_s)";
  else if (reply.reason == Reason::kCycleIsOver)
    text << std::fixed << std::setprecision(0) << ": at_cycle = " << reply.value
         << " has passed, this is cycle " << reply.limit << "; " << reply.limit + 1.0
         << " or later is allowed";
  else if (reply.reason == Reason::kVelocitiesContradict)
    text << ": velocity_rad_s is " << std::setprecision(kShownDigits) << reply.value
         << " times the rate at which position_rad changes" << unit_of_velocity(reply.value)
         << ", and the daemon ended the stream; send rad/s at the joint, or positions alone (derivatives 0)";
  else if (reply.reason == Reason::kStreamEnded)
    text << " and yielded to a load of " << std::setprecision(kShownDigits) << reply.value
         << " N.m (joint.limits.load_Nm allows " << limit
         << "), which ended this stream of setpoints; begin a new one once the joint holds";
  else if (reply.reason == Reason::kFarFromJoint)
    text << ": the stream begins " << value << " rad from the joint's planned position; at most " << limit
         << " rad are allowed (joint.limits.following_error_rad): move there first, or set approach = 1";
  else if (kind == OrderKind::kUseTable)
    text << ": with this table it may hold a load of " << value << " N.m, but it holds " << limit
         << " N.m now: disable it first, or load a table with a higher torque_limit_Nm";
  else
    text << ": at_cycle is " << value << " s ahead; at most " << limit << " s are allowed";
  return text.str();
}

// Advice on an order for all joints of a path; empty where the general advice applies.
std::string path_advice(const Reply& reply, OrderKind kind) {
  if (reply.reason == Reason::kMoving)
    return kind == OrderKind::kLoadPath ? ": a path is loaded only while it holds; hold it first"
                                        : ": one of the path's joints moves; hold that joint first";
  if (reply.reason != Reason::kWrongMode) return "";
  if (kind == OrderKind::kLoadPath) return ": a path needs it enabled and holding";
  return ": no path is loaded or in progress, or one of the path's joints is not enabled";
}

// Advice on an order that has no effect in the joint's mode: why, and what to do instead.
std::string mode_advice(Mode mode, OrderKind kind) {
  if (kind == OrderKind::kHold) {
    if (mode == Mode::kOff)
      return ": it has no torque and no motion to stop; enable makes it hold its position";
    if (mode == Mode::kFaulted)
      return ": its drive is off already; clear the fault, then enable makes it hold its position";
    return mode == Mode::kStopping ? ": it is stopping already, and then its drive switches off"
                                   : ": it will hold once it is on";
  }
  if (kind == OrderKind::kClearFault) return ": it has no fault to clear";
  switch (mode) {
    case Mode::kOff:
      return ": enable it first";
    case Mode::kStarting:
    case Mode::kReleasing:
      return ": it is being enabled; wait until it holds";
    case Mode::kStopping:
      return ": it is being disabled; wait until it is off, then enable it";
    case Mode::kHoming:
      return ": wait until it has found home and holds, or hold it first";
    case Mode::kTracking:
      return kind == OrderKind::kHome ? ": homing begins at rest; hold it first"
                                      : ": this command does nothing while it moves";
    case Mode::kHolding:
    case Mode::kFaulted:
      break;
  }
  return ": this command does nothing in this mode";
}

}  // namespace

std::string refusal_advice(const Reply& reply, OrderKind kind) {
  std::string mode = "the joint is " + std::string(to_text(reply.mode));
  if (reply.limit != 0.0) return mode + number_refused(reply, kind);
  if (is_of_path(kind))
    if (const std::string text = path_advice(reply, kind); !text.empty()) return mode + text;
  switch (reply.reason) {
    case Reason::kNoTable:
      return mode + ": load a gain table first (joint.table, or strainwavectl load-table)";
    case Reason::kFaulted:
      return mode + ": see its fault, remove the cause, clear the fault";
    case Reason::kMoving:
      return mode + (kind == OrderKind::kUseTable
                         ? ": a table is taken over only at standstill; hold or disable it first"
                         : ": it yields to a load; wait until it holds");
    case Reason::kEnding:
      return mode + ", and the daemon is ending and brings every joint to rest: start the daemon again";
    case Reason::kStreamEnded:
      return mode +
             ", and this stream of setpoints has ended: it expired, or a hold, stop, fault, enable or "
             "another command ended it. Begin a new one";
    case Reason::kTooOld:
      return mode + ": the command waited in the daemon too long, or was sent before a fault; send it again";
    case Reason::kVelocitiesContradict:
      return mode +
             ": velocity_rad_s is not the rate at which position_rad changes, and the daemon ended the "
             "stream; send rad/s at the joint, or positions alone (derivatives 0)";
    case Reason::kNotHomed:
      return mode + ", and its position is not known: home it first";
    case Reason::kAtLimitSwitch:
      return mode + " at a limit switch: only a move away from it is possible";
    case Reason::kNoHoming:
      return mode + ", and joint.homing names no switch or index as its home";
    case Reason::kDriveNotReady:
      return mode + ", and its drive gives no position: check supply and connection";
    case Reason::kWrongMode:
      return mode + mode_advice(reply.mode, kind);
    default:
      return mode;
  }
}

}  // namespace strainwave
