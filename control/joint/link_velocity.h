// SPDX-License-Identifier: BSD-3-Clause
// How the velocity of a link behind the gear's spring is taken from its encoder, and why. Real-time safe.
//
//   velocity+ = velocity + share (two readings' difference / h - velocity)         share = h / kLinkVelocity_s
//
// Between torque and reading lies the spring: what drives the motor turns the link half a turn of its swing later. A velocity of two readings,
// which is fed back with gains for both inertias, therefore drives the swing, unless it is damped well or the gains are soft. Over 8 ms the
// velocity of swings of 50 Hz and more is small and a quarter late; what is left of the law there is its position feedback, one to three periods
// late, and that damps. Motions of the joint itself are slower.
#pragma once

#include <algorithm>

#include "control/joint/encoder_side.h"

namespace strainwave {

inline constexpr double kLinkVelocity_s = 0.008;

/// Of each difference of two readings, on a joint with a spring; 1 where the encoder is the motor's.
constexpr double velocity_share(EncoderSide side, double period_s) noexcept {
  return side == EncoderSide::kLink ? std::min(1.0, period_s / kLinkVelocity_s) : 1.0;
}

}  // namespace strainwave
