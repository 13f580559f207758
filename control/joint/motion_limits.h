// SPDX-License-Identifier: BSD-3-Clause
// Limits of a trajectory. Joint side, SI.
#pragma once

namespace strainwave {

/// All > 0 and finite.
struct MotionLimits {
  double velocity_rad_s = 1.0;
  double acceleration_rad_s2 = 1.0;  ///< while the speed grows
  double deceleration_rad_s2 = 1.0;  ///< while the speed falls; friction makes this limit the larger one
};

}  // namespace strainwave
