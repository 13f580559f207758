// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/reading_watch.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace strainwave {

ReadingDoubt ReadingWatch::not_finite(const ActuatorReading& reading) noexcept {
  if (!std::isfinite(reading.joint_position_rad)) return ReadingDoubt::kPositionNotFinite;
  if (reading.has_velocity && !std::isfinite(reading.joint_velocity_rad_s))
    return ReadingDoubt::kVelocityNotFinite;
  return std::isfinite(reading.torque_applied_Nm) ? ReadingDoubt::kNone : ReadingDoubt::kTorqueNotFinite;
}

ReadingWatch::Freshness ReadingWatch::judge(const ActuatorReading& reading) noexcept {
  if (!reading.has_position) return Freshness::kNone;
  return not_finite(reading) == ReadingDoubt::kNone ? Freshness::kFresh : Freshness::kMalformed;
}

const ActuatorReading& ReadingWatch::take(const ActuatorReading& reading, bool controlled,
                                          double velocity_rad_s, const CycleTime& time) noexcept {
  freshness_ = judge(reading);
  const double last_position_rad = reading_.joint_position_rad;
  const double elapsed_s = static_cast<double>(time.elapsed_periods) * period_s_;
  reading_ = reading;
  if (!fresh()) {
    // Where the joint must be by now: a position that stands still and then jumps would look like a blocked joint.
    reading_.joint_position_rad = last_position_rad + (controlled ? velocity_rad_s * elapsed_s : 0.0);
    reading_.has_velocity = false;
    reading_.torque_applied_Nm = 0.0;
    reading_.torque_measured = false;
  }
  const std::int64_t missed = missed_ + time.elapsed_periods;
  missed_ = fresh() ? 0 : static_cast<int>(std::min<std::int64_t>(missed, missed_limit_ + 1));
  // A brake that is shut holds the joint whatever the torque.
  const bool driven = reading.drive_state == DriveState::kEnabled && controlled && !reading.brake_shut;
  // What a joint may have moved by counts from where it was sampled: after a stall the newest position is of the time before.
  const std::int64_t sampled_ns = time.now_ns - nanoseconds(reading.position_late_periods * period_s_);
  const bool possible = !fresh() || position_check_.plausible(reading.joint_position_rad,
                                                              reading.torque_applied_Nm, driven, sampled_ns);
  if (reading_.fault == ActuatorFault::kImplausible)
    reading_.drive_error = doubt_number(ReadingDoubt::kCountsMissing);
  if (reading_.fault == ActuatorFault::kNone && (freshness_ == Freshness::kMalformed || !possible)) {
    reading_.fault = ActuatorFault::kImplausible;
    reading_.drive_error = possible ? doubt_number(not_finite(reading)) : position_check_.doubt();
  }
  return reading_;
}

}  // namespace strainwave
