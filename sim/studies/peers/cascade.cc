// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/cascade.h"

#include <algorithm>

namespace strainwave {

namespace {

constexpr double kNotchShare = 0.1;  // width at -3 dB as a share of the resonance

}  // namespace

CascadePeer::CascadePeer(const ServoJoint& joint, bool feedforward, std::optional<NotchFilter> notch) noexcept
    : joint_(joint),
      bandwidth_rad_s_(velocity_bandwidth_rad_s(joint)),
      share_(feedforward ? 1.0 : 0.0),
      difference_(joint.period_s),
      notch_(notch) {}

double CascadePeer::step(const Reference& reference, double joint_position_rad) noexcept {
  const double velocity_rad_s = difference_.step(joint_position_rad);
  const double gain_Nms_rad = joint_.inertia_kgm2 * bandwidth_rad_s_;
  const double wanted_rad_s = 0.25 * bandwidth_rad_s_ * (reference.position_rad - joint_position_rad) +
                              share_ * reference.velocity_rad_s;
  const double error_Nm = gain_Nms_rad * (wanted_rad_s - velocity_rad_s);
  const double wanted_Nm =
      error_Nm + integral_Nm_ + share_ * joint_.inertia_kgm2 * reference.acceleration_rad_s2;
  const double filtered_Nm = notch_ ? notch_->step(wanted_Nm) : wanted_Nm;
  const double torque_Nm = std::clamp(filtered_Nm, -joint_.torque_limit_Nm, joint_.torque_limit_Nm);
  // Anti-windup: a saturated drive holds its integral.
  if (torque_Nm == filtered_Nm) integral_Nm_ += 0.5 * bandwidth_rad_s_ * joint_.period_s * error_Nm;
  return torque_Nm;
}

void CascadePeer::reset(double joint_position_rad) noexcept {
  difference_.reset();
  difference_.step(joint_position_rad);
  if (notch_) notch_->reset();
  integral_Nm_ = 0.0;
}

std::unique_ptr<CascadePeer> notched_cascade(ServoJoint joint) {
  const NotchFilter notch(joint.resonance_rad_s, kNotchShare, joint.period_s);
  joint.filter_s = kNotchShare / joint.resonance_rad_s;
  return std::make_unique<CascadePeer>(joint, true, notch);
}

}  // namespace strainwave
