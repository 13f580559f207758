// SPDX-License-Identifier: BSD-3-Clause
// How fast a move is that names no speed. Not real-time.
#pragma once

namespace strainwave {

/// Of the joint's speed limit, unless joint.limits.move_speed_share says another: a move by hand that one can follow with the eye, as robot
/// controllers have it by default.
inline constexpr double kCalmShare = 0.25;

}  // namespace strainwave
