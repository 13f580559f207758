// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/disturbance_observer.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

constexpr double kObserverShare = 0.5;  // of the velocity loop's bandwidth

}  // namespace

DisturbanceObserverPeer::DisturbanceObserverPeer(const ServoJoint& joint) noexcept
    : joint_(joint),
      bandwidth_rad_s_(velocity_bandwidth_rad_s(joint)),
      observer_rad_s_(kObserverShare * bandwidth_rad_s_),
      observer_share_(-std::expm1(-observer_rad_s_ * joint.period_s)),
      difference_(joint.period_s) {}

double DisturbanceObserverPeer::step(const Reference& reference, double joint_position_rad) noexcept {
  const double velocity_rad_s = difference_.step(joint_position_rad);
  const double momentum_Nm = observer_rad_s_ * joint_.inertia_kgm2 * velocity_rad_s;
  const double acted_Nm = joint_.delay_periods >= 0.5 ? acting_Nm_ : applied_Nm_;
  filtered_Nm_ += observer_share_ * (acted_Nm + momentum_Nm - filtered_Nm_);
  const double position_gain = 0.25 * bandwidth_rad_s_ * bandwidth_rad_s_;
  const double wanted_rad_s2 = reference.acceleration_rad_s2 +
                               bandwidth_rad_s_ * (reference.velocity_rad_s - velocity_rad_s) +
                               position_gain * (reference.position_rad - joint_position_rad);
  acting_Nm_ = applied_Nm_;
  applied_Nm_ = std::clamp(joint_.inertia_kgm2 * wanted_rad_s2 + filtered_Nm_ - momentum_Nm,
                           -joint_.torque_limit_Nm, joint_.torque_limit_Nm);
  return applied_Nm_;
}

void DisturbanceObserverPeer::reset(double joint_position_rad) noexcept {
  difference_.reset();
  difference_.step(joint_position_rad);
  filtered_Nm_ = applied_Nm_ = acting_Nm_ = 0.0;
}

}  // namespace strainwave
