// SPDX-License-Identifier: BSD-3-Clause
// A move, and how it ended. Not real-time.
#pragma once

namespace strainwave {

/// A move that takes longer is refused: it is most likely a mistake.
inline constexpr double kLongestMove_s = 3600.0;

/// The target and the limits of a move, joint side.
struct MoveOrder {
  double position_rad = 0.0;
  double speed_limit_rad_s = 0.0;  ///< 0: joint.limits.move_speed_share of the joint's limit
  double tolerance_rad = 1e-3;     ///< distance from the target at which the joint has arrived
};

struct Arrival {
  double duration_s = 0.0;  ///< from the order until the joint was inside the tolerance for good
  double error_rad = 0.0;   ///< target minus position, at the end
};

}  // namespace strainwave
