// SPDX-License-Identifier: BSD-3-Clause
// The effects that distinguish a strain-wave joint from one rigid inertia, one small type per effect. Each is
// off by default. Joint side, SI, plain data. Sources: data/gears.csv, docs/flexible-joint.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "control/joint/gravity_load.h"
#include "control/joint/torsion_spring.h"

namespace strainwave {

/// The gear does not turn evenly. At the motor's angle N theta the output leads by
///   e(theta) = sum over n = 1, 2 of a_n sin(n N theta + phi_n)
struct KinematicError {
  std::array<double, 2> amplitude_rad{};  ///< a_1 and a_2 at the joint: once and twice per motor turn
  std::array<double, 2> phase_rad{};      ///< phi_1 and phi_2

  bool on() const noexcept { return amplitude_rad[0] != 0.0 || amplitude_rad[1] != 0.0; }
  /// e, with the motor's own shaft at `turn_rad` = N theta.
  double value_rad(double turn_rad) const noexcept {
    return amplitude_rad[0] * std::sin(turn_rad + phase_rad[0]) +
           amplitude_rad[1] * std::sin(2.0 * turn_rad + phase_rad[1]);
  }
  /// de/d(N theta).
  double slope(double turn_rad) const noexcept {
    return amplitude_rad[0] * std::cos(turn_rad + phase_rad[0]) +
           2.0 * amplitude_rad[1] * std::cos(2.0 * turn_rad + phase_rad[1]);
  }
  /// The least slope of a turn, <= 0, with a relative error of 1e-6. The gear would turn back if 1 + N slope <= 0 anywhere.
  double least_slope() const noexcept {
    constexpr int kAngles = 4096;
    double least = 0.0;
    for (int k = 0; k < kAngles; ++k) least = std::min(least, slope(2.0 * std::numbers::pi * k / kAngles));
    return least;
  }
};

/// The spring's loss that does not depend on speed. A sliding element parallel to the spring yields as the gear winds up:
///   dz/dt = w - |w| z / (h/2),   torque = K1 z
/// The wind-up at zero torque then differs by h between the two directions of loading.
struct LostMotion {
  double width_rad = 0.0;  ///< h >= 0
};

/// Gear and link. Without a transmission the joint is rigid, and its whole inertia is at the motor.
struct Transmission {
  double link_inertia_kgm2 = 0.0;  ///< Jl > 0
  TorsionSpring spring;
  double damping_Nms_rad = 0.0;  ///< D >= 0, on the rate of the wind-up
  LostMotion lost_motion;
  KinematicError kinematic_error;
  double link_coulomb_Nm = 0.0;       ///< friction of the output bearing, with stiction of the same size
  double link_viscous_Nms_rad = 0.0;  ///< >= 0
};

/// Friction effects beyond the Stribeck curve.
struct FrictionEffects {
  double transmitted_share = 0.0;  ///< share of transmitted torque added to static and Coulomb friction; >= 0
  /// Elastic creep before sliding (LuGre): the angle at which the bristles carry static friction; 0: true stiction.
  double presliding_rad = 0.0;
  /// Share in (-1, 1) by which all friction exceeds the curve in the positive direction, and falls short of it in the other.
  double direction_share = 0.0;
};

/// Effects between the command and the torque.
struct DriveEffects {
  double current_loop_s = 0.0;          ///< time constant; 0: no lag
  double ripple_share = 0.0;            ///< amplitude as a share of the torque, in [0, 1)
  double ripple_per_motor_turn = 12.0;  ///< cycles
};

/// An obstacle for the link: a spring and a damper above a position, which only push. A stop is a stiff obstacle.
struct Contact {
  double position_rad = 0.0;
  double stiffness_Nm_rad = 0.0;  ///< 0: no obstacle
  double damping_Nms_rad = 0.0;   ///< >= 0

  double torque_Nm(double link_position_rad, double link_velocity_rad_s) const noexcept {
    const double depth_rad = link_position_rad - position_rad;
    if (stiffness_Nm_rad <= 0.0 || depth_rad <= 0.0) return 0.0;
    const double push_Nm = stiffness_Nm_rad * depth_rad + damping_Nms_rad * link_velocity_rad_s;
    return push_Nm > 0.0 ? push_Nm : 0.0;
  }
};

struct JointEffects {
  double gear_ratio = 50.0;  ///< N > 0: motor turns per joint turn, for effects that repeat per motor turn
  std::optional<Transmission> transmission;
  FrictionEffects friction;
  DriveEffects drive;
  GravityLoad gravity;
  Contact contact;

  /// Whether the joint is anything but one rigid inertia with Stribeck friction.
  bool any() const noexcept {
    return transmission || friction.presliding_rad > 0.0 || friction.direction_share != 0.0 ||
           drive.current_loop_s > 0.0 || drive.ripple_share > 0.0 || gravity.torque_Nm != 0.0 ||
           contact.stiffness_Nm_rad > 0.0;
  }
};

}  // namespace strainwave
