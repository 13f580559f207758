// SPDX-License-Identifier: BSD-3-Clause
// Torques and accelerations that motor, supply and friction allow. Joint side, SI. Real-time safe. Source: data/rhs17_datasheet.csv.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/joint/joint_model.h"
#include "control/joint/motion_limits.h"

namespace strainwave {

/// Data-sheet values of motor and supply, seen at the joint: with a gear of ratio N and efficiency n,
///   Kt = N n Kt_motor
///   Ke = N Ke_motor
struct MotorData {
  double peak_torque_Nm = std::numeric_limits<double>::infinity();
  double torque_constant_Nm_A = 0.0;  ///< Kt > 0
  double back_emf_Vs_rad = 0.0;       ///< Ke >= 0
  double resistance_ohm = 0.0;        ///< R; 0: not known
  double supply_V = 0.0;              ///< V; 0: not known
};

/// The motor's torque limits as straight lines over speed; by default none. They neglect the winding's inductance.
///   driving:  |Tm| <= min(peak, stall - slope |w|)
///   braking:  the back-EMF adds to the supply, so |Tm| <= min(peak, stall + slope |w|)
struct MotorLimits {
  double peak_torque_Nm = std::numeric_limits<double>::infinity();   ///< > 0
  double stall_torque_Nm = std::numeric_limits<double>::infinity();  ///< Kt V / R > 0
  double torque_per_speed_Nms_rad = 0.0;                             ///< Kt Ke / R >= 0

  /// The peak torque, and the line if resistance and supply are known.
  static constexpr MotorLimits from_motor(const MotorData& motor) noexcept {
    MotorLimits limits;
    limits.peak_torque_Nm = motor.peak_torque_Nm;
    if (motor.resistance_ohm > 0.0 && motor.supply_V > 0.0) {
      limits.stall_torque_Nm = motor.torque_constant_Nm_A * motor.supply_V / motor.resistance_ohm;
      limits.torque_per_speed_Nms_rad =
          motor.torque_constant_Nm_A * motor.back_emf_Vs_rad / motor.resistance_ohm;
    }
    return limits;
  }

  /// Largest torque, >= 0, along a motion with `velocity_rad_s` (< 0: against it, where back-EMF helps).
  double available_Nm(double velocity_rad_s) const noexcept {
    return std::max(0.0,
                    std::min(peak_torque_Nm, stall_torque_Nm - torque_per_speed_Nms_rad * velocity_rad_s));
  }
  /// `torque_Nm`, limited to the torque available at `velocity_rad_s`.
  double limit_Nm(double torque_Nm, double velocity_rad_s) const noexcept {
    const double along_rad_s = torque_Nm < 0.0 ? -velocity_rad_s : velocity_rad_s;
    return std::copysign(std::min(std::abs(torque_Nm), available_Nm(along_rad_s)), torque_Nm);
  }
};

/// Torque limits for planning a motion, joint side.
struct TorqueLimits {
  double driving_Nm = 0.0;  ///< >= 0, at most braking_Nm; less where the joint is hot
  double braking_Nm = 0.0;  ///< > 0
};

/// Possible acceleration and deceleration at `speed_rad_s` >= 0, under `torque`, the motor's limits, friction and load.
/// The share `reserve` of the torque is left to the feedback. Friction reduces the acceleration and adds to the deceleration; the load
/// reduces both. Limits: at least the acceleration by 2 % of the braking torque, at most `motion`.
MotionLimits reachable_limits(const MotionLimits& motion, const MotorLimits& motor, const JointModel& model,
                              double load_Nm, const TorqueLimits& torque, double reserve, double speed_rad_s,
                              double period_s) noexcept;

}  // namespace strainwave
