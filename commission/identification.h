// SPDX-License-Identifier: BSD-3-Clause
// Identifies a joint from a trace of its motion. It needs no particular motion: each function uses the suitable parts of the trace, and
// returns nothing if there is too little. Not real-time. Joint side, SI.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "commission/estimates.h"
#include "commission/joint_trace.h"

namespace strainwave {

/// +1 if positive torque moves the joint to larger positions, else -1. Over a motion out and back friction takes up the torque's work, so a
/// positive work means +1. Nothing if the joint hardly moved, or if the work out and back nearly cancels.
std::optional<int> find_direction(const JointTrace& trace);

/// Absolute torque at which the joint left rest, as means by direction (first positive). The half width follows from the spread, and is at
/// least the change of torque between leaving rest and sliding.
std::array<std::optional<IntervalEstimate>, 2> find_breakaway(const JointTrace& trace, double gear_ratio);

struct FrictionSearch {
  double gear_ratio = 0.0;    ///< N > 0
  double inertia_kgm2 = 0.0;  ///< motor and link, for the accelerating torque; 0: not known
  double delay_s = 0.0;       ///< from a command to its torque; 0: not known
};

/// With inertia and delay from `motion`, if it is known, to remove the accelerating torque.
FrictionSearch friction_search(double gear_ratio, const std::optional<MotionEstimates>& motion);

/// Friction over speed from whole motor turns at steady speed, the same turn in both directions:
///   F(w) = (mean torque there - mean torque back) / 2
std::vector<FrictionAtSpeed> find_friction(const JointTrace& trace, const FrictionSearch& search);

/// Delay, inertias, spring, damping, gravity and kinematic error by nonlinear least squares over stretches in which the motor slides one
/// way. Nothing if there are fewer than kLeastWindows stretches, if the motion is too even to show the inertia, or if no model fits.
std::optional<MotionEstimates> fit_motion(const JointTrace& trace, const ToldJoint& told);
inline constexpr int kLeastWindows = 6;

/// All of the above.
JointEstimates identify(const JointTrace& trace, const ToldJoint& told);

}  // namespace strainwave
