// SPDX-License-Identifier: BSD-3-Clause
// Results of an identification, each number with its confidence interval. Joint side, SI. Plain data.
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

/// Data of the joint from catalogue or configuration, from which a fit starts.
struct ToldJoint {
  double gear_ratio = 0.0;          ///< N > 0
  TorsionSpring spring;             ///< the fit keeps its shape and scales all three slopes by one factor
  double lost_motion_rad = 0.0;     ///< h >= 0
  double motor_inertia_kgm2 = 0.0;  ///< Jm > 0, right to a factor of three; the wave generator's suffices
};

/// Friction of steady motion, the mean of both directions.
struct FrictionAtSpeed {
  double speed_rad_s = 0.0;
  double temperature_C = 0.0;
  IntervalEstimate torque_Nm;
};

/// Estimates from torque and position while the motor slides. A number is absent if its half width is above 5 %, or 2 % for a resonance
/// and half for damping. Stiffness and resonances are also absent if the half width of the lost motion is above 20 %.
struct MotionEstimates {
  IntervalEstimate
      delay_s;  ///< from a command to its torque: the drive's delay and the time constant of its current loop
  IntervalEstimate total_inertia_kgm2;
  std::optional<IntervalEstimate> motor_inertia_kgm2;
  std::optional<IntervalEstimate> link_inertia_kgm2;
  std::optional<IntervalEstimate> stiffness_1_Nm_rad;  ///< the spring's first slope
  std::optional<IntervalEstimate> damping_Nms_rad;
  std::optional<IntervalEstimate> resonance_Hz;      ///< motor against link, at the first slope
  std::optional<IntervalEstimate> antiresonance_Hz;  ///< link against a motor at rest
  IntervalEstimate gravity_Nm;                       ///< m g l >= 0
  double gravity_zero_rad = 0.0;  ///< where the link hangs; meaningless if gravity is 0 within its interval
  std::array<IntervalEstimate, 2> kinematic_error_rad;  ///< amplitudes once and twice per motor turn
  double residual_rad = 0.0;                            ///< root mean square of the residuals (window_fit.h)
  int windows = 0;                                      ///< number of windows in the fit
};

struct JointEstimates {
  std::optional<int>
      direction;  ///< +1: positive torque moves the joint to larger positions; -1: the other way
  std::optional<IntervalEstimate> breakaway_positive_Nm;  ///< torque at which the joint began to slide
  std::optional<IntervalEstimate> breakaway_negative_Nm;  ///< absolute value
  std::vector<FrictionAtSpeed> friction;                  ///< by rising speed
  std::optional<MotionEstimates> motion;
};

}  // namespace strainwave
