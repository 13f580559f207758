// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/jog_motion.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

JogMotion::JogMotion(double position_rad, const JogLimits& limits)
    : limits_(limits),
      position_rad_(std::clamp(position_rad, limits.position_min_rad, limits.position_max_rad)) {}

void JogMotion::step(double wanted_rad_s, double step_s) {
  const double a = limits_.acceleration_rad_s2;
  const double up_rad_s =
      std::min(limits_.speed_rad_s, std::sqrt(2.0 * a * (limits_.position_max_rad - position_rad_)));
  const double down_rad_s =
      std::min(limits_.speed_rad_s, std::sqrt(2.0 * a * (position_rad_ - limits_.position_min_rad)));
  const double reached_rad_s =
      std::clamp(wanted_rad_s, velocity_rad_s_ - a * step_s, velocity_rad_s_ + a * step_s);
  const double next_rad_s = std::clamp(reached_rad_s, -down_rad_s, up_rad_s);
  const double next_rad = position_rad_ + 0.5 * (velocity_rad_s_ + next_rad_s) * step_s;
  position_rad_ = std::clamp(next_rad, limits_.position_min_rad, limits_.position_max_rad);
  velocity_rad_s_ = position_rad_ == next_rad ? next_rad_s : 0.0;
}

}  // namespace strainwave
