// SPDX-License-Identifier: BSD-3-Clause
// Identifies a joint from a trace of its motion. It needs no particular motion: each function takes from the trace what it can use, and
// returns nothing where there is too little. Not real-time. Joint side, SI.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "commission/estimates.h"
#include "commission/joint_trace.h"

namespace strainwave {

/// Whether positive torque moves the joint to larger positions, by the sign of the torque's work: what a joint that comes back to where it
/// was takes up is lost to friction, so it is positive. Nothing where the joint hardly moved, or work out and back nearly cancel.
std::optional<int> find_direction(const JointTrace& trace);

/// Sizes of the torque at which the joint left rest, means by direction (first positive); half width from their spread, and at least
/// what the torque changed by from the first count to sliding.
std::array<std::optional<IntervalEstimate>, 2> find_breakaway(const JointTrace& trace, double gear_ratio);

struct FrictionSearch {
  double gear_ratio = 0.0;    ///< N > 0
  double inertia_kgm2 = 0.0;  ///< motor and link: what changes of the speed took; 0: not known
  double delay_s = 0.0;       ///< from an order to its torque; 0: not known
};

/// With what `motion`, where it is known, says of torque that is not friction's.
FrictionSearch friction_search(double gear_ratio, const std::optional<MotionEstimates>& motion);

/// Friction over speed from whole motor turns at steady speed, the same turn in both directions:
///   F(w) = (mean torque there - mean torque back) / 2
std::vector<FrictionAtSpeed> find_friction(const JointTrace& trace, const FrictionSearch& search);

/// Delay, inertias, spring, damping, gravity and kinematic error by nonlinear least squares over stretches in which the motor slides one
/// way. Nothing when there are fewer than kLeastWindows stretches, when the motion is too even to show the inertia, or when no model fits.
std::optional<MotionEstimates> fit_motion(const JointTrace& trace, const ToldJoint& told);
inline constexpr int kLeastWindows = 6;

/// All of the above.
JointEstimates identify(const JointTrace& trace, const ToldJoint& told);

}  // namespace strainwave
