// SPDX-License-Identifier: BSD-3-Clause
// The codes in messages and their meaning: modes, faults, notices, reasons, actions. A published number never gets
// another meaning. Texts are for people; programs compare numbers. Real-time safe: the texts are constants.
// docs/faults.md and docs/messages.md explain each.
#pragma once

#include <cstdint>
#include <string_view>

namespace strainwave {

/// state_v1.mode
enum class Mode : std::int32_t {
  kOff = 0,
  kStarting = 1,
  kHolding = 2,
  kTracking = 3,
  kStopping = 4,
  kFaulted = 5,
  kHoming = 6,
  kReleasing = 7
};

/// state_v1.fault: latched, the joint is stopped.
enum class Fault : std::int32_t {
  kNone = 0,
  kReadFailed = 1,
  kWriteRefused = 2,
  kDriveFault = 3,
  kPowerLost = 4,
  kImplausibleReading = 5,
  kConnectionLost = 6,
  kEmergencyStop = 7,
  kDriveRestarted = 8,
  kBusError = 9,
  kStartTimeout = 10,
  kStopTimeout = 11,
  kPositionLimit = 12,
  kSpeedLimit = 13,
  kFollowingError = 14,
  kNotFinite = 15,
  kTemperatureLimit = 17,
  kGroup = 18,
  kHomingFailed = 19,
  kLimitSwitch = 20,
  kLoopStalled = 21,
  kPeriodsMissed = 22,
  kBlocked = 23,
  kOverload = 24,
  kTemperatureLost = 25,
  kChatter = 26,
};

/// state_v1.notices: a bit set. The joint goes on, but with limits. kYielded reports a past event.
enum class Notice : std::int32_t {
  kTorqueLimited = 1 << 0,
  kTemperatureClamped = 1 << 1,
  kSetpointExpired = 1 << 3,
  kReadingMissed = 1 << 4,
  kSpeedLimited = 1 << 5,
  kNotHomed = 1 << 6,
  kAtLimitSwitch = 1 << 7,
  kOffStream = 1 << 9,
  kPositionLate = 1 << 10,
  kOffTarget = 1 << 11,
  kLoadHigh = 1 << 12,
  kOtherInertia = 1 << 13,
  kPathPaused = 1 << 14,
  kYielded = 1 << 16,
  kSamplesMissing = 1 << 17,
  kFrictionDiffers = 1 << 18,
  kVelocitiesContradict = 1 << 19,
  kDerated = 1 << 20,
};

/// ack_v1.reason; also the index into timing_v1.rejects.
enum class Reason : std::int32_t {
  kAccepted = 0,
  kMalformed = 1,
  kNotFinite = 2,
  kOutOfRange = 3,
  kWrongMode = 4,
  kNoTable = 5,
  kUnknownJoint = 6,
  kWrongSession = 7,
  kOldSequence = 8,
  kUnsigned = 9,
  kBadSignature = 10,
  kRoleNotAllowed = 11,
  kTableDefect = 12,
  kTableIdentity = 13,
  kTablePeriod = 14,
  kTableNotCertified = 15,
  kFaulted = 16,
  kBusy = 17,
  kMoving = 18,
  kNoPreviousTable = 19,
  kUnknownAction = 20,
  kTimedOut = 21,
  kDriveNotReady = 22,
  kSuperseded = 23,
  kNotSimulated = 24,
  kStreamEnded = 25,
  kNotHomed = 26,
  kAtLimitSwitch = 27,
  kNoHoming = 28,
  kEnding = 29,
  kTooOld = 30,
  kNotOwner = 31,
  kFarFromJoint = 32,
  kVelocitiesContradict = 33,
  kCycleIsOver = 34,
};
inline constexpr int kReasonCount = 35;

/// command_v1.action
enum class Action : std::int32_t {
  kEnable = 1,
  kDisable = 2,
  kHold = 3,
  kClearFault = 4,
  kRevertTable = 5,
  kHome = 6,
  kTakeOver = 7,
  kRelease = 8,
  kPause = 9,
  kResume = 10,
  kResetLearning = 11,
  kFreezeLearning = 12,
  kResumeLearning = 13
};

/// state_v1.temperature_status
enum class TemperatureStatus : std::int32_t {
  kValid = 0,
  kNeverSeen = 1,
  kTooOld = 2,
  kOutOfRange = 3,
  kTooFast = 4
};

/// One or two words each, lower case; "unknown" for a number without a meaning.
std::string_view to_text(Mode mode) noexcept;
std::string_view to_text(Fault fault) noexcept;
std::string_view to_text(Notice notice) noexcept;
std::string_view to_text(Reason reason) noexcept;
std::string_view to_text(Action action) noexcept;
std::string_view to_text(TemperatureStatus status) noexcept;

/// Returns the configuration key of the limit behind a fault or notice ("joint.limits.torque_limit_Nm"); empty when there is none.
std::string_view configuration_key(Fault fault) noexcept;
std::string_view configuration_key(Notice notice) noexcept;

}  // namespace strainwave
