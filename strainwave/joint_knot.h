// SPDX-License-Identifier: BSD-3-Clause
// A knot of a path: where a joint is at a time, and how fast. Not real-time.
#pragma once

namespace strainwave {

/// Joint side.
struct JointKnot {
  double time_s = 0.0;  ///< since the start; the first 0, rising
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;  ///< the first and the last 0
};

}  // namespace strainwave
