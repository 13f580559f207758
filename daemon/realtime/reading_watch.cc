#include "daemon/realtime/reading_watch.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

ReadingWatch::Freshness ReadingWatch::judge(const ActuatorReading& reading) noexcept {
  if (!reading.has_position) return Freshness::kNone;
  const bool numbers = std::isfinite(reading.joint_position_rad) &&
                       (!reading.has_velocity || std::isfinite(reading.joint_velocity_rad_s)) &&
                       std::isfinite(reading.torque_applied_Nm);
  return numbers ? Freshness::kFresh : Freshness::kMalformed;
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
  }
  const std::int64_t missed = missed_ + time.elapsed_periods;
  missed_ = fresh() ? 0 : static_cast<int>(std::min<std::int64_t>(missed, missed_limit_ + 1));
  // A brake that is shut holds the joint whatever the torque.
  const bool driven = reading.drive_state == DriveState::kEnabled && controlled && !reading.brake_shut;
  const bool possible = !fresh() || position_check_.plausible(reading.joint_position_rad,
                                                              reading.torque_applied_Nm, driven, time.now_ns);
  if ((freshness_ == Freshness::kMalformed || !possible) && reading_.fault == ActuatorFault::kNone)
    reading_.fault = ActuatorFault::kImplausible;
  return reading_;
}

}  // namespace strainwave
