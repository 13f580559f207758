// Above 300 lines: the texts of every number of vocabulary.h, a table each.
#include "lcmtypes/vocabulary.h"

namespace strainwave {

std::string_view to_text(Mode mode) noexcept {
  switch (mode) {
    case Mode::kOff:
      return "off";
    case Mode::kStarting:
      return "starting";
    case Mode::kHolding:
      return "holding";
    case Mode::kTracking:
      return "tracking";
    case Mode::kStopping:
      return "stopping";
    case Mode::kFaulted:
      return "faulted";
    case Mode::kHoming:
      return "homing";
    case Mode::kReleasing:
      return "releasing";
  }
  return "unknown";
}

std::string_view to_text(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kReadFailed:
      return "position reading failed";
    case Fault::kWriteRefused:
      return "torque command refused by the drive";
    case Fault::kDriveFault:
      return "drive fault";
    case Fault::kPowerLost:
      return "supply lost";
    case Fault::kImplausibleReading:
      return "implausible reading";
    case Fault::kLinkLost:
      return "link to the drive lost";
    case Fault::kEmergencyStop:
      return "emergency stop";
    case Fault::kDriveRestarted:
      return "drive restarted by itself";
    case Fault::kBusError:
      return "bus error";
    case Fault::kStartTimeout:
      return "drive did not enable in time";
    case Fault::kStopTimeout:
      return "joint did not stop in time";
    case Fault::kPositionLimit:
      return "position limit";
    case Fault::kSpeedLimit:
      return "speed limit";
    case Fault::kFollowingError:
      return "following error";
    case Fault::kNotFinite:
      return "not-a-number in the loop";
    case Fault::kOverruns:
      return "too many overruns in a row";
    case Fault::kTemperatureLimit:
      return "temperature limit";
    case Fault::kGroup:
      return "another joint of the group faulted";
    case Fault::kHomingFailed:
      return "homing failed";
    case Fault::kLimitSwitch:
      return "limit switch";
    case Fault::kLoopStalled:
      return "loop stalled";
    case Fault::kPeriodsMissed:
      return "too many periods missed";
    case Fault::kBlocked:
      return "joint is blocked";
    case Fault::kOverload:
      return "load too large";
    case Fault::kTemperatureLost:
      return "temperature lost";
    case Fault::kChatter:
      return "joint chatters";
  }
  return "unknown";
}

std::string_view to_text(Notice notice) noexcept {
  switch (notice) {
    case Notice::kTorqueLimited:
      return "torque limited";
    case Notice::kTemperatureClamped:
      return "temperature outside the table";
    case Notice::kFallbackGains:
      return "temperature-free gains in use";
    case Notice::kSetpointExpired:
      return "setpoint stream expired";
    case Notice::kReadingMissed:
      return "reading missed";
    case Notice::kSpeedLimited:
      return "speed limited";
    case Notice::kNotHomed:
      return "not homed";
    case Notice::kAtLimitSwitch:
      return "at a limit switch";
    case Notice::kOffStream:
      return "off the stream";
    case Notice::kPositionLate:
      return "position late";
    case Notice::kOffTarget:
      return "off target";
    case Notice::kLoadHigh:
      return "load high";
    case Notice::kOtherInertia:
      return "inertia not as told";
    case Notice::kPathPaused:
      return "path paused";
    case Notice::kPathEnds:
      return "path ends early";
    case Notice::kYielded:
      return "yielded to a load";
    case Notice::kSamplesMissing:
      return "samples missing";
    case Notice::kFrictionDiffers:
      return "friction differs from the table";
    case Notice::kVelocitiesContradict:
      return "velocities contradict positions";
  }
  return "unknown";
}

// NOLINTNEXTLINE(readability-function-size): a table
std::string_view to_text(Reason reason) noexcept {
  switch (reason) {
    case Reason::kAccepted:
      return "accepted";
    case Reason::kMalformed:
      return "malformed message";
    case Reason::kNotFinite:
      return "not a finite number";
    case Reason::kOutOfRange:
      return "out of range";
    case Reason::kWrongMode:
      return "not possible in this mode";
    case Reason::kNoTable:
      return "no gain table loaded";
    case Reason::kUnknownJoint:
      return "unknown joint";
    case Reason::kWrongSession:
      return "another session of the daemon";
    case Reason::kOldSequence:
      return "sequence not rising";
    case Reason::kUnsigned:
      return "not signed";
    case Reason::kBadSignature:
      return "wrong signature";
    case Reason::kRoleNotAllowed:
      return "role not allowed to do this";
    case Reason::kTableDefect:
      return "table has a defect";
    case Reason::kTableIdentity:
      return "table is for another joint";
    case Reason::kTablePeriod:
      return "table is for another period";
    case Reason::kTableNotCertified:
      return "table not certified for this joint";
    case Reason::kFaulted:
      return "joint is faulted";
    case Reason::kBusy:
      return "busy, try again";
    case Reason::kMoving:
      return "joint is moving";
    case Reason::kNoPreviousTable:
      return "no previous table";
    case Reason::kUnknownAction:
      return "unknown action";
    case Reason::kTimedOut:
      return "timed out";
    case Reason::kDriveNotReady:
      return "drive not ready";
    case Reason::kSuperseded:
      return "superseded by a newer command";
    case Reason::kNotSimulated:
      return "only a simulated drive takes injected faults";
    case Reason::kStreamEnded:
      return "setpoint stream has ended";
    case Reason::kNotHomed:
      return "joint is not homed";
    case Reason::kAtLimitSwitch:
      return "limit switch in that direction";
    case Reason::kNoHoming:
      return "no homing configured";
    case Reason::kEnding:
      return "daemon is ending";
    case Reason::kTooOld:
      return "order is too old";
    case Reason::kNotOwner:
      return "another client has the joint";
    case Reason::kFarFromJoint:
      return "stream begins far from the joint";
    case Reason::kVelocitiesContradict:
      return "velocities contradict positions";
  }
  return "unknown";
}

std::string_view to_text(Action action) noexcept {
  switch (action) {
    case Action::kEnable:
      return "enable";
    case Action::kDisable:
      return "disable";
    case Action::kHold:
      return "hold";
    case Action::kClearFault:
      return "clear-fault";
    case Action::kRevertTable:
      return "revert-table";
    case Action::kHome:
      return "home";
    case Action::kTakeOver:
      return "take-over";
    case Action::kRelease:
      return "release";
    case Action::kPause:
      return "pause";
    case Action::kResume:
      return "resume";
    case Action::kResetLearning:
      return "reset-learning";
    case Action::kFreezeLearning:
      return "freeze-learning";
    case Action::kResumeLearning:
      return "resume-learning";
  }
  return "unknown";
}

std::string_view to_text(TemperatureStatus status) noexcept {
  switch (status) {
    case TemperatureStatus::kValid:
      return "valid";
    case TemperatureStatus::kNeverSeen:
      return "never seen";
    case TemperatureStatus::kTooOld:
      return "too old";
    case TemperatureStatus::kOutOfRange:
      return "out of range";
    case TemperatureStatus::kTooFast:
      return "changing too fast";
    case TemperatureStatus::kNotChanging:
      return "not changing";
  }
  return "unknown";
}

std::string_view to_text(GainsInUse gains) noexcept {
  switch (gains) {
    case GainsInUse::kNone:
      return "none";
    case GainsInUse::kPrimary:
      return "scheduled";
    case GainsInUse::kFallback:
      return "temperature-free";
  }
  return "unknown";
}

std::string_view configuration_key(Fault fault) noexcept {
  switch (fault) {
    case Fault::kReadFailed:
      return "joint.supervision.missed_readings_limit";
    case Fault::kImplausibleReading:
      return "joint.limits.overspeed_rad_s";
    case Fault::kStartTimeout:
      return "joint.supervision.start_timeout_s";
    case Fault::kStopTimeout:
      return "joint.supervision.stop_timeout_s";
    case Fault::kPositionLimit:
      return "joint.limits.position_margin_rad";
    case Fault::kSpeedLimit:
      return "joint.limits.overspeed_rad_s";
    case Fault::kFollowingError:
      return "joint.limits.following_error_rad";
    case Fault::kOverruns:
      return "daemon.overrun_limit";
    case Fault::kTemperatureLimit:
      return "joint.limits.temperature_limit_C";
    case Fault::kGroup:
      return "joint.on_fault";
    case Fault::kHomingFailed:
      return "joint.homing";
    case Fault::kLoopStalled:
      return "daemon.stall_limit_s";
    case Fault::kPeriodsMissed:
      return "daemon.missed_share_limit";
    case Fault::kBlocked:
      return "joint.supervision.blocked_s";
    case Fault::kOverload:
      return "joint.limits.load_Nm";
    case Fault::kTemperatureLost:
      return "joint.temperature.on_loss";
    case Fault::kChatter:
      return "joint.model";
    case Fault::kNone:
    case Fault::kWriteRefused:
    case Fault::kDriveFault:
    case Fault::kPowerLost:
    case Fault::kLinkLost:
    case Fault::kEmergencyStop:
    case Fault::kLimitSwitch:
    case Fault::kDriveRestarted:
    case Fault::kBusError:
    case Fault::kNotFinite:
      return "";
  }
  return "";
}

std::string_view configuration_key(Notice notice) noexcept {
  switch (notice) {
    case Notice::kTorqueLimited:
      return "joint.limits.torque_limit_Nm";
    case Notice::kTemperatureClamped:
      return "joint.table";
    case Notice::kFallbackGains:
      return "joint.temperature";
    case Notice::kSetpointExpired:
      return "";
    case Notice::kReadingMissed:
      return "joint.supervision.missed_readings_limit";
    case Notice::kSpeedLimited:
      return "joint.limits.speed_limit_rad_s";
    case Notice::kNotHomed:
      return "joint.homing.required";
    case Notice::kAtLimitSwitch:
      return "";
    case Notice::kOffStream:
      return "joint.limits";
    case Notice::kPositionLate:
      return "joint.can.delay_periods";
    case Notice::kOffTarget:
      return "joint.supervision.rest_tolerance_rad";
    case Notice::kLoadHigh:
      return "joint.limits.load_notice_Nm";
    case Notice::kOtherInertia:
      return "joint.model";
    case Notice::kPathPaused:
    case Notice::kPathEnds:
      return "";
    case Notice::kYielded:
      return "joint.limits.load_Nm";
    case Notice::kSamplesMissing:
      return "joint.control.stream_bridge_s";
    case Notice::kFrictionDiffers:
      return "joint.table";
    case Notice::kVelocitiesContradict:
      return "";
  }
  return "";
}

}  // namespace strainwave
