// SPDX-License-Identifier: BSD-3-Clause
// The physical limit of a flexible joint: the torque that brings the link to its setpoint with the least sum
// |e / r|. A linear programme finds it over the torque of every period. Offline.
//
// The programme's plant is the linear joint: motor, link, one spring, one damper, and known Coulomb and viscous
// friction. The motor turns one way only. Its torque is held over each period, within peak torque and the supply's
// line. A spring of several slopes counts with its secant at the torque that its fastest motion transmits. At rest
// and at low speed true friction is higher than Coulomb friction, so the limit is not above the truth.
#pragma once

#include <optional>
#include <vector>

#include "sim/studies/closed_loop.h"

namespace strainwave {

struct LinkLimitConfig {
  double motor_inertia_kgm2 = 0.0;
  double link_inertia_kgm2 = 0.0;
  double stiffness_Nm_rad = 0.0;
  double damping_Nms_rad = 0.0;
  double link_viscous_Nms_rad = 0.0;
  FrictionParameters friction;  ///< of the motor, at the temperature of the motion
  MotorLimits motor;            ///< with a finite peak torque
  double load_torque_Nm = 0.0;  ///< at the link, opposes positive torque
  double period_s = 1e-3;
  int delay_periods = 0;  ///< periods before the first torque acts
  double step_rad = 0.0;  ///< from rest, != 0
};

/// The programme's configuration of `plant` at `temperature_C`, for a step of `step_rad` under
/// `load_torque_Nm`. Throws InputError without a transmission or a finite peak torque.
LinkLimitConfig link_limit_config(const JointPlantConfig& plant, double temperature_C, double step_rad,
                                  double load_torque_Nm = 0.0);

struct LinkLimit {
  double pi2 = 0.0;                       ///< sum |e / r| of the link over the samples, the first included
  double counted_pi2 = 0.0;               ///< for the same motion, only samples with |e| > kCountedError_rad
  std::vector<double> link_position_rad;  ///< at every sample
  std::vector<double> torque_Nm;          ///< over every period
};

/// Errors below this are two counts of the reference encoder, which a joint at rest may show.
inline constexpr double kCountedError_rad = 40e-6;

/// Throws InputError if the torque cannot move the joint, or if the step takes more periods than are solved for (700).
LinkLimit find_link_limit(const LinkLimitConfig& config);

/// The least time in s, in whole periods, after which the link stays within `band_rad` > 0 of its setpoint.
double least_settling_time_s(const LinkLimitConfig& config, double band_rad);

}  // namespace strainwave
