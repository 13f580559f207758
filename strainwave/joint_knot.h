// SPDX-License-Identifier: BSD-3-Clause
// A knot of a path: time, position and velocity of a joint. Not real-time.
#pragma once

namespace strainwave {

/// Joint side.
struct JointKnot {
  double time_s = 0.0;  ///< since the start; 0 in the first knot, rising
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;  ///< 0 in the first and the last knot
};

}  // namespace strainwave
