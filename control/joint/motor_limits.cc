// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/motor_limits.h"

#include <algorithm>

namespace strainwave {

namespace {
// Least acceleration of a reference, as a share of the acceleration by the torque limit without friction and load.
constexpr double kLeastAccelerating = 0.02;
}  // namespace

MotionLimits reachable_limits(const MotionLimits& motion, const MotorLimits& motor, const JointModel& model,
                              double load_Nm, const TorqueLimits& torque, double reserve, double speed_rad_s,
                              double period_s) noexcept {
  const double usable = 1.0 - reserve;
  const double limit_Nm = usable * std::min(torque.driving_Nm, motor.peak_torque_Nm);
  const double braking_Nm = usable * std::min(torque.braking_Nm, motor.peak_torque_Nm);
  const double supply_Nm = usable * motor.stall_torque_Nm - motor.torque_per_speed_Nms_rad * speed_rad_s;
  const double coulomb_Nm = model.friction.coulomb_Nm;
  const double against_Nm = std::abs(load_Nm);
  const double viscous_Nm = model.friction.viscous_Nms_rad * speed_rad_s;

  // The losses grow with the speed during the period, hence with the acceleration: the denominator accounts for that.
  const double damping =
      model.friction.viscous_Nms_rad + (supply_Nm < limit_Nm ? motor.torque_per_speed_Nms_rad : 0.0);
  const double driving_Nm = std::min(limit_Nm, supply_Nm) - coulomb_Nm - viscous_Nm - against_Nm;
  const double acceleration = driving_Nm / (model.inertia_kgm2 + period_s * damping);
  // Viscous friction also brakes, but vanishes towards the end of the motion.
  const double deceleration = (braking_Nm + coulomb_Nm - against_Nm) / model.inertia_kgm2;

  // At the speed where losses take all of the torque less the reserve, the reference stops accelerating, in spite of the least acceleration.
  // So it does not run ahead of the joint, and braking the reference brakes the joint.
  const double least_Nm = kLeastAccelerating * braking_Nm;
  const auto fastest = [&](double torque_Nm, double loss_Nms_rad) {
    return std::max(least_Nm, torque_Nm - coulomb_Nm - against_Nm) / loss_Nms_rad;
  };
  const double velocity = std::min(fastest(limit_Nm, model.friction.viscous_Nms_rad),
                                   fastest(usable * motor.stall_torque_Nm,
                                           model.friction.viscous_Nms_rad + motor.torque_per_speed_Nms_rad));

  const double least = least_Nm / model.inertia_kgm2;
  return {std::min(motion.velocity_rad_s, velocity),
          std::min(motion.acceleration_rad_s2, std::max(least, acceleration)),
          std::min(motion.deceleration_rad_s2, std::max(least, deceleration))};
}

}  // namespace strainwave
