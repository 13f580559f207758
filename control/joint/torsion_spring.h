// SPDX-License-Identifier: BSD-3-Clause
// The gear as a spring: stiffness in three steps over the transmitted torque, odd in the angle, without loss. Joint side, SI.
// Real-time safe. Source: data/gears.csv (the catalogue's K1 up to T1, K2 up to T2, K3 beyond).
#pragma once

#include <algorithm>
#include <cmath>

namespace strainwave {

struct TorsionSpring {
  double stiffness_1_Nm_rad = 0.0;  ///< K1 > 0, up to torque_1_Nm
  double torque_1_Nm = 0.0;         ///< T1 >= 0
  double stiffness_2_Nm_rad = 0.0;  ///< K2 > 0, up to torque_2_Nm
  double torque_2_Nm = 0.0;         ///< T2 >= T1
  double stiffness_3_Nm_rad = 0.0;  ///< K3 > 0, beyond

  /// A spring with one slope.
  static constexpr TorsionSpring linear(double stiffness_Nm_rad) noexcept {
    return {stiffness_Nm_rad, 0.0, stiffness_Nm_rad, 0.0, stiffness_Nm_rad};
  }
  /// Every slope times `factor` > 0.
  constexpr TorsionSpring scaled(double factor) const noexcept {
    return {factor * stiffness_1_Nm_rad, torque_1_Nm, factor * stiffness_2_Nm_rad, torque_2_Nm,
            factor * stiffness_3_Nm_rad};
  }

  /// Torque in N.m at a wind-up of `angle_rad`.
  double torque_Nm(double angle_rad) const noexcept {
    const double angle = std::abs(angle_rad);
    const double end_1 = torque_1_Nm / stiffness_1_Nm_rad;
    if (angle <= end_1) return stiffness_1_Nm_rad * angle_rad;
    const double end_2 = end_1 + (torque_2_Nm - torque_1_Nm) / stiffness_2_Nm_rad;
    const double torque = angle <= end_2 ? torque_1_Nm + stiffness_2_Nm_rad * (angle - end_1)
                                         : torque_2_Nm + stiffness_3_Nm_rad * (angle - end_2);
    return std::copysign(torque, angle_rad);
  }

  /// Wind-up in rad at which the spring transmits `torque_Nm`.
  double angle_rad(double torque_Nm) const noexcept {
    const double torque = std::abs(torque_Nm);
    const double angle =
        std::min(torque, torque_1_Nm) / stiffness_1_Nm_rad +
        std::clamp(torque - torque_1_Nm, 0.0, torque_2_Nm - torque_1_Nm) / stiffness_2_Nm_rad +
        std::max(0.0, torque - torque_2_Nm) / stiffness_3_Nm_rad;
    return std::copysign(angle, torque_Nm);
  }

  /// Slope of that wind-up, rad/(N.m).
  double compliance_rad_Nm(double torque_Nm) const noexcept {
    const double torque = std::abs(torque_Nm);
    return 1.0 / (torque < torque_1_Nm   ? stiffness_1_Nm_rad
                  : torque < torque_2_Nm ? stiffness_2_Nm_rad
                                         : stiffness_3_Nm_rad);
  }

  /// Slope of the straight line from rest to `torque_Nm` > 0, N.m/rad.
  double secant_Nm_rad(double torque_Nm) const noexcept { return torque_Nm / angle_rad(torque_Nm); }
};

/// Angular frequency in rad/s at which motor and link swing against each other on a spring of `stiffness_Nm_rad`.
inline double free_free_frequency_rad_s(double motor_inertia_kgm2, double link_inertia_kgm2,
                                        double stiffness_Nm_rad) noexcept {
  return std::sqrt(stiffness_Nm_rad * (1.0 / motor_inertia_kgm2 + 1.0 / link_inertia_kgm2));
}

/// Damping that gives this swing, on a spring of `stiffness_Nm_rad`, the share `ratio` of critical damping.
inline double structural_damping_Nms_rad(double motor_inertia_kgm2, double link_inertia_kgm2,
                                         double stiffness_Nm_rad, double ratio) noexcept {
  return 2.0 * ratio * stiffness_Nm_rad /
         free_free_frequency_rad_s(motor_inertia_kgm2, link_inertia_kgm2, stiffness_Nm_rad);
}

}  // namespace strainwave
