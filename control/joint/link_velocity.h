// SPDX-License-Identifier: BSD-3-Clause
// Filter for the velocity of a link behind the gear's spring, and the reason for it. Real-time safe.
//
//   velocity+ = velocity + share (two readings' difference / h - velocity)         share = h / kLinkVelocity_s
//
// The spring lies between torque and reading: at the swing's frequency, the link turns half a swing later than the torque. Feedback of a
// velocity of two readings, with gains for both inertias, therefore excites the swing, unless damping is high or the gains are soft. With
// a filter of 8 ms the velocity of swings of 50 Hz and more is small and a quarter of a swing late. Then mainly position feedback acts on the
// swing, one to three periods late, and damps it. Motions of the joint itself are slower.
#pragma once

#include <algorithm>

#include "control/joint/encoder_side.h"

namespace strainwave {

inline constexpr double kLinkVelocity_s = 0.008;

/// Share of each position difference that enters the velocity of a flexible joint; 1 for an encoder on the motor.
constexpr double velocity_share(EncoderSide side, double period_s) noexcept {
  return side == EncoderSide::kLink ? std::min(1.0, period_s / kLinkVelocity_s) : 1.0;
}

}  // namespace strainwave
