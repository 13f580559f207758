// SPDX-License-Identifier: BSD-3-Clause
// Estimates a joint's parameters from a recorded motion by least squares. Joint side, SI. Not real-time.
//
//   tau(t - d) = Jm q'' + Jl l''(q + e(q)) + Fc sign(q') + Fv q' + b + gs sin q + gc cos q
//
//   Jl l''     = scale spring(q + e(q) - l) + damping - load(q),    load = b + gs sin q + gc cos q
//
// q is the measured position, tau the commanded torque, l the link on the configured spring, and e the gear's kinematic error. The slope of
// e changes the share of the link's torque that acts on the motor. Both sides are weighted by a bump phi(t) and integrated, which moves the
// derivatives to phi: Int phi q'' = Int phi'' q. Windows at rest or with lost torque are left out. Jm .. gc are linear; d and scale are found
// on a grid. The link's equation is nonlinear: a second pass linearises it about the e and the load of the first.
#pragma once

#include <optional>

#include "doctor/evidence.h"

namespace strainwave {

/// A quantity and its standard deviation.
struct MotionEstimate {
  double value = 0.0;
  double deviation = 0.0;
};

struct MotionFit {
  MotionEstimate inertia_kgm2;  ///< Jm + Jl; negative: the torque acts against its sign
  MotionEstimate coulomb_Nm;
  MotionEstimate viscous_Nms_rad;
  MotionEstimate delay_periods;
  std::optional<MotionEstimate> stiffness_scale;  ///< over the configured; nothing: rigid, or not found
  double load_Nm = 0.0;                           ///< largest load beyond the configured gravity, signed
  double load_at_rad = 0.0;                       ///< position of that load
  double load_deviation_Nm = 0.0;
  double acceleration_rad_s2 = 0.0;  ///< reached in one of ten windows
  double remainder_Nm = 0.0;         ///< standard deviation of the residuals
  int windows = 0;
};

/// Nothing if there are fewer than kLeastMotionWindows windows of motion.
std::optional<MotionFit> fit_motion(const Evidence& evidence);

inline constexpr int kLeastMotionWindows = 12;

}  // namespace strainwave
