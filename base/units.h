// SPDX-License-Identifier: BSD-3-Clause
// Conversions between the catalogue's units and the project's. Real-time safe.
//
// Inside the project every quantity is SI and on the joint (output, low-speed) side of the gear. The
// manufacturer's catalogue states torques in N.cm and speeds in RPM at the motor (high-speed) side. With
// ratio N:
//   joint torque   = N * motor torque            (no efficiency term: it is part of the measured friction)
//   joint velocity = motor velocity / N
//   joint viscous  = N^2 * motor viscous
// Source: Zhao (2006), section 2.3 and Table 5.
#pragma once

#include <numbers>

namespace strainwave {

/// One revolution.
inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;
/// rad/s for one RPM.
inline constexpr double kRadPerSecondPerRpm = kTurn_rad / 60.0;
/// N.m for one N.cm.
inline constexpr double kNmPerNcm = 0.01;

/// Joint-side torque in N.m of a motor-side torque in N.cm.
constexpr double joint_torque_Nm_from_motor_Ncm(double motor_torque_Ncm, double gear_ratio) {
  return gear_ratio * kNmPerNcm * motor_torque_Ncm;
}

/// Joint-side velocity in rad/s of a motor-side speed in RPM.
constexpr double joint_velocity_rad_s_from_motor_rpm(double motor_rpm, double gear_ratio) {
  return kRadPerSecondPerRpm * motor_rpm / gear_ratio;
}

/// Joint-side viscous coefficient in N.m.s/rad of a motor-side one in N.cm per RPM.
constexpr double joint_viscous_Nms_rad_from_motor_Ncm_per_rpm(double motor_viscous_Ncm_per_rpm,
                                                              double gear_ratio) {
  return gear_ratio * gear_ratio * kNmPerNcm / kRadPerSecondPerRpm * motor_viscous_Ncm_per_rpm;
}

/// -1, 0 or 1.
constexpr double sign(double value) {
  return static_cast<double>(value > 0.0) - static_cast<double>(value < 0.0);
}
constexpr double square(double x) {
  return x * x;
}

}  // namespace strainwave
