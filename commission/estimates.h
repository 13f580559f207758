// SPDX-License-Identifier: BSD-3-Clause
// What an identification finds of a joint, each number with its interval. Joint side, SI. Plain data.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "control/joint/torsion_spring.h"

namespace strainwave {

/// The true value is within half_width_95 of `value` in 95 of 100 cases.
struct IntervalEstimate {
  double value = 0.0;
  double half_width_95 = 0.0;

  bool holds(double truth) const noexcept {
    return truth >= value - half_width_95 && truth <= value + half_width_95;
  }
};

/// What the catalogue or the configuration says of the joint, from which a fit starts.
struct ToldJoint {
  double gear_ratio = 0.0;  ///< N > 0
  TorsionSpring spring;     ///< its shape is kept; its stiffness is fitted as one factor of all three slopes
  double lost_motion_rad = 0.0;     ///< h >= 0
  double motor_inertia_kgm2 = 0.0;  ///< Jm > 0, within a factor of three: the wave generator's alone will do
};

/// Friction of steady motion, the mean of both directions.
struct FrictionAtSpeed {
  double speed_rad_s = 0.0;
  double temperature_C = 0.0;
  IntervalEstimate torque_Nm;
};

/// Of the motion: what torque and position say together while the motor slides. Absent is what the trace does not show: a half width
/// above 5 %, of a resonance above 2 %, of damping above half. So are stiffness and resonances where the lost motion's is above 20 %.
struct MotionEstimates {
  IntervalEstimate
      delay_s;  ///< from an order to its torque: the drive's delay and the time constant of its current loop
  IntervalEstimate total_inertia_kgm2;
  std::optional<IntervalEstimate> motor_inertia_kgm2;
  std::optional<IntervalEstimate> link_inertia_kgm2;
  std::optional<IntervalEstimate> stiffness_1_Nm_rad;  ///< the spring's first slope
  std::optional<IntervalEstimate> damping_Nms_rad;
  std::optional<IntervalEstimate> resonance_Hz;      ///< motor against link, at the first slope
  std::optional<IntervalEstimate> antiresonance_Hz;  ///< link against a motor that stands
  IntervalEstimate gravity_Nm;                       ///< m g l >= 0
  double gravity_zero_rad =
      0.0;  ///< where the link hangs; meaningless where gravity is 0 within its interval
  std::array<IntervalEstimate, 2> kinematic_error_rad;  ///< amplitudes once and twice per motor turn
  double residual_rad = 0.0;  ///< root mean square of what the fit leaves of the position
  int windows = 0;            ///< stretches of motion that it was made from
};

struct JointEstimates {
  std::optional<int>
      direction;  ///< +1: positive torque moves the joint to larger positions; -1: the other way
  std::optional<IntervalEstimate> breakaway_positive_Nm;  ///< torque at which the joint began to slide
  std::optional<IntervalEstimate> breakaway_negative_Nm;  ///< its size
  std::vector<FrictionAtSpeed> friction;                  ///< by rising speed
  std::optional<MotionEstimates> motion;
};

}  // namespace strainwave
