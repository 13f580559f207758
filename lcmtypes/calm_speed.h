// SPDX-License-Identifier: BSD-3-Clause
// The speed of a move without a speed of its own. Not real-time.
#pragma once

namespace strainwave {

/// Default of joint.limits.move_speed_share, as a share of the joint's speed limit. The eye can follow such a move; robot
/// controllers have the same default for moves by hand.
inline constexpr double kCalmShare = 0.25;

}  // namespace strainwave
