// SPDX-License-Identifier: BSD-3-Clause
// The joint of the catalogue: RHS-17-6006 actuator, ratio 50, harmonic grease SK-2. Joint side, SI.
// Source: Zhao (2006), Table 3 (with Fs1 = 6.6525: the printed 8.2525 does not give the printed cost;
// docs/theory.md), Stribeck velocity 20 RPM of the motor, and data/rhs17_datasheet.csv.
#pragma once

#include "base/units.h"
#include "control/joint/gear_catalogue.h"
#include "sim/joint/joint_plant.h"

namespace strainwave {

inline constexpr double kReferenceGearRatio = 50.0;
inline constexpr double kReferenceInertia_kgm2 = 0.089;
inline constexpr double kReferenceCountsPerRevolution = 320000.0;
inline constexpr double kReferencePeakTorque_Nm = 34.0;

constexpr FrictionParameters joint_friction_from_motor(double static_Ncm, double coulomb_Ncm,
                                                       double viscous_Ncm_per_rpm) {
  return {joint_torque_Nm_from_motor_Ncm(static_Ncm, kReferenceGearRatio),
          joint_torque_Nm_from_motor_Ncm(coulomb_Ncm, kReferenceGearRatio),
          joint_viscous_Nms_rad_from_motor_Ncm_per_rpm(viscous_Ncm_per_rpm, kReferenceGearRatio)};
}

/// Inertia and friction.
constexpr JointParameters reference_joint() {
  JointParameters joint;
  joint.inertia_kgm2 = kReferenceInertia_kgm2;
  joint.stribeck = {joint_velocity_rad_s_from_motor_rpm(20.0, kReferenceGearRatio), 2.0};
  joint.friction = {joint_friction_from_motor(3.1204, 1.5204, 0.0011702),
                    joint_friction_from_motor(6.6525, 6.6525, 0.01181), -12.803, 11.28};
  return joint;
}

/// Torque constant, supply and back-EMF of the datasheet.
constexpr MotorData reference_motor() {
  return {kReferencePeakTorque_Nm, 9.6, 1.0 / kRadPerSecondPerRpm, 4.8, 75.0};
}

/// Thermal resistance and time constant of the datasheet; the sensor follows at once.
constexpr ThermalParameters reference_thermal() {
  return {1.2, 960.0, 0.0};
}

/// The setting of Zhao (2006): exact state, no torque limit, no delay.
inline JointPlantConfig ideal_plant() {
  JointPlantConfig config;
  config.joint = reference_joint();
  constexpr MotorData kMotor = reference_motor();
  config.winding_loss_W_Nm2 = kMotor.resistance_ohm / square(kMotor.torque_constant_Nm_A);
  return config;
}

/// Exact state, but no more torque than the actuator's peak.
inline JointPlantConfig torque_limited_plant() {
  JointPlantConfig config = ideal_plant();
  config.motor.peak_torque_Nm = kReferencePeakTorque_Nm;
  return config;
}

/// The joint of the datasheet: only an encoder, one period of computation, peak torque, supply and back-EMF.
inline JointPlantConfig realistic_plant() {
  JointPlantConfig config = ideal_plant();
  config.motor = MotorLimits::from_motor(reference_motor());
  config.encoder.counts_per_joint_revolution = kReferenceCountsPerRevolution;
  config.delay.periods = 1.0;
  return config;
}

/// The realistic joint behind a gear of size 17 and ratio 50. The motor's side has the actuator's inertia,
/// and the link has the same. The structural damping is 2 %.
inline JointPlantConfig flexible_plant() {
  JointPlantConfig config = realistic_plant();
  Transmission transmission;
  transmission.link_inertia_kgm2 = kReferenceInertia_kgm2;
  transmission.spring = find_gear("csf-17-50")->spring;
  transmission.damping_Nms_rad = structural_damping_Nms_rad(
      kReferenceInertia_kgm2, transmission.link_inertia_kgm2, transmission.spring.stiffness_1_Nm_rad, 0.02);
  config.effects.transmission = transmission;
  return config;
}

}  // namespace strainwave
