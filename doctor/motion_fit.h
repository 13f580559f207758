// SPDX-License-Identifier: BSD-3-Clause
// What a recorded motion shows of the joint, by least squares. Joint side, SI. Not real-time.
//
//   tau(t - d) = Jm q'' + Jl l''(q + e(q)) + Fc sign(q') + Fv q' + b + gs sin q + gc cos q
//
//   Jl l''     = scale spring(q + e(q) - l) + damping - load(q),    load = b + gs sin q + gc cos q
//
// q is the measured position, tau the torque commanded, l the link on the configured spring, e the gear's kinematic error, by whose slope the
// motor feels more or less of the link's torque. Both sides are weighted by a bump phi(t) and integrated, so that phi takes the derivatives:
// Int phi q'' = Int phi'' q. Windows in which the joint rests or the torque is lost are left out. Jm .. gc are linear; d and scale are found
// on a grid. The link's equation is not linear: a second pass writes it about the e and the load of the first.
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
  std::optional<MotionEstimate>
      stiffness_scale;   ///< over the configured; nothing: rigid, or motions do not show it
  double load_Nm = 0.0;  ///< what the position alone explains beyond the configured gravity, largest amount
  double load_at_rad = 0.0;  ///< where
  double load_deviation_Nm = 0.0;
  double acceleration_rad_s2 = 0.0;  ///< of one window in ten or more
  double remainder_Nm = 0.0;         ///< standard deviation of what is not explained
  int windows = 0;
};

/// Nothing: fewer than kLeastMotionWindows windows of motion.
std::optional<MotionFit> fit_motion(const Evidence& evidence);

inline constexpr int kLeastMotionWindows = 12;

}  // namespace strainwave
