// What the motor and its supply can do: a peak torque and, above a speed, the voltage that back-EMF leaves.
// Joint side. Real-time safe. Source: data/rhs17_datasheet.csv.
//
//   driving:  |Tm| <= min(peak, Kt (V - Ke |w|) / R)      braking: the back-EMF adds to the supply
// The electrical time constant (0.5 ms) is taken as zero: the drive's current loop is closed inside the
// limit.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/units.h"

namespace strainwave {

/// Datasheet values, joint side.
struct MotorParameters {
  double peak_torque_Nm = 0.0;
  double supply_V = 0.0;
  double resistance_ohm = 0.0;
  double torque_constant_Nm_A = 0.0;
  double back_emf_V_rpm = 0.0;
};

/// The limit as a line over speed. Default: no limit.
struct TorqueEnvelope {
  double peak_Nm = std::numeric_limits<double>::infinity();
  double stall_Nm = std::numeric_limits<double>::infinity();  ///< Kt V / R
  double slope_Nms_rad = 0.0;                                 ///< Kt Ke / R

  /// Largest torque in N.m available in the direction of `along` = velocity times the torque's sign.
  double available_Nm(double along_rad_s) const noexcept {
    return std::max(0.0, std::min(peak_Nm, stall_Nm - slope_Nms_rad * along_rad_s));
  }
  /// `torque_Nm`, limited at `velocity_rad_s`.
  double limit_Nm(double torque_Nm, double velocity_rad_s) const noexcept {
    const double along_rad_s = torque_Nm < 0.0 ? -velocity_rad_s : velocity_rad_s;
    return std::copysign(std::min(std::abs(torque_Nm), available_Nm(along_rad_s)), torque_Nm);
  }
};

/// Peak torque, supply and back-EMF.
constexpr TorqueEnvelope torque_envelope(const MotorParameters& motor) {
  return {motor.peak_torque_Nm, motor.torque_constant_Nm_A * motor.supply_V / motor.resistance_ohm,
          motor.torque_constant_Nm_A * motor.back_emf_V_rpm / (kRadPerSecondPerRpm * motor.resistance_ohm)};
}

/// Peak torque only.
constexpr TorqueEnvelope peak_torque_only(double peak_torque_Nm) {
  TorqueEnvelope envelope;
  envelope.peak_Nm = peak_torque_Nm;
  return envelope;
}

}  // namespace strainwave
