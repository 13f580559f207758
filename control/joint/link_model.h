// SPDX-License-Identifier: BSD-3-Clause
// Motor and link with the gear's spring between them, as configured, and the regulator that brings both to the plan. The model contains no
// friction, which is compensated separately. Real-time safe except for regulate(). Joint side, SI.
//
//   Jm wm' = u - ts
//   Jl wl' = ts - load(thl)
//   ts     = spring(thm - thl) + D (wm - wl)
#pragma once

#include <limits>

#include "control/joint/gravity_load.h"
#include "control/joint/torsion_spring.h"

namespace strainwave {

struct LinkState {
  double link_position_rad = 0.0, link_velocity_rad_s = 0.0;
  double motor_position_rad = 0.0, motor_velocity_rad_s = 0.0;
};

/// `from` plus `share` times `by`. `by` may be a derivative by time or the difference to another state.
LinkState moved(const LinkState& from, const LinkState& by, double share) noexcept;

/// Torque in N.m, held over a period, for each error of the LinkState at the period's end.
struct LinkGains {
  double link_position = 0.0, link_velocity = 0.0, motor_position = 0.0, motor_velocity = 0.0;
};

struct LinkModel {
  double motor_inertia_kgm2 = 0.0;  ///< Jm > 0
  double link_inertia_kgm2 = 0.0;   ///< Jl > 0; 0: rigid
  TorsionSpring spring;
  double damping_Nms_rad = 0.0;  ///< D >= 0
  GravityLoad gravity;

  /// Motor and link as one inertia, the sum of both, without a gear between them.
  static LinkModel rigid_joint(double inertia_kgm2) noexcept {
    return {inertia_kgm2, 0.0, TorsionSpring::linear(std::numeric_limits<double>::infinity()), 0.0, {}};
  }
  bool rigid() const noexcept { return link_inertia_kgm2 == 0.0; }
  double inertia_kgm2() const noexcept { return motor_inertia_kgm2 + link_inertia_kgm2; }

  /// Result of a period of `period_s` under `torque_Nm`.
  struct Period {
    LinkState end;
    double middle_velocity_rad_s = 0.0;  ///< of the motor, half-way through the period
  };
  Period advance(const LinkState& from, double torque_Nm, double period_s) const noexcept;

  /// The linear quadratic regulator of the joint with the spring's second slope, with the torque held over each period:
  ///   u = (R + B'PB)^-1 B'P e,    e: error that the period would end with without u
  /// If the joint keeps to the plan this is -F of the state (control/joint/riccati.h); otherwise it also counts the error that the period itself
  /// adds. The weights balance a share of `torque_limit_Nm` against a small part of the wind-up that it makes (link_model.cc).
  /// Not real-time safe.
  LinkGains regulate(double torque_limit_Nm, double period_s) const noexcept;
};

/// Torque by `gains` for the error between `is`, the state at the end of a period without it, and `should_be`.
double regulated_torque_Nm(const LinkGains& gains, const LinkState& should_be, const LinkState& is) noexcept;

}  // namespace strainwave
