// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/servo_peer.h"

#include <algorithm>
#include <limits>

namespace strainwave {

ServoJoint servo_joint(const JointPlantConfig& plant) {
  ServoJoint joint;
  joint.period_s = plant.period_s;
  joint.delay_periods = plant.delay.periods;
  joint.motor_inertia_kgm2 = joint.inertia_kgm2 = plant.joint.inertia_kgm2;
  joint.torque_limit_Nm = plant.motor.peak_torque_Nm;
  joint.encoder_resolution_rad = plant.encoder.resolution_rad();
  joint.resonance_rad_s = std::numeric_limits<double>::infinity();
  if (!plant.effects.transmission) return joint;
  const Transmission& gear = *plant.effects.transmission;
  joint.inertia_kgm2 += gear.link_inertia_kgm2;
  joint.stiffness_Nm_rad = 0.5 * (gear.spring.stiffness_1_Nm_rad + gear.spring.stiffness_2_Nm_rad);
  joint.damping_Nms_rad = gear.damping_Nms_rad;
  joint.resonance_rad_s = free_free_frequency_rad_s(plant.joint.inertia_kgm2, gear.link_inertia_kgm2,
                                                    gear.spring.stiffness_1_Nm_rad);
  return joint;
}

double velocity_bandwidth_rad_s(const ServoJoint& joint) noexcept {
  const double motor_alone_rad_s = joint.motor_inertia_kgm2 / joint.inertia_kgm2 / joint.small_times_s();
  return std::min(
      {0.5 / (joint.small_times_s() + joint.filter_s), 0.5 * joint.resonance_rad_s, motor_alone_rad_s});
}

}  // namespace strainwave
