// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint_controller.h"

#include <algorithm>
#include <cmath>

#include "control/joint/link_velocity.h"

namespace strainwave {

namespace {

double share_of_velocity(const JointControllerConfig& config) noexcept {
  return config.link ? velocity_share(config.encoder_side, config.period_s) : 1.0;
}

}  // namespace

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config),
      plan_(config),
      law_(config.period_s, config.encoder_resolution_rad, share_of_velocity(config),
           config.link.has_value()),
      reading_(config.period_s, share_of_velocity(config), count_of(config)),
      oscillation_(config.period_s) {}

void JointController::load(const GainTable& table) noexcept {
  law_.load(table);
  model_.inertia_kgm2 = config_.link ? config_.link->inertia_kgm2() : table.plant.inertia_kgm2;
  if (!config_.link) plan_.set_rigid_inertia(table.plant.inertia_kgm2);
  model_.stribeck = table.friction.velocity.stribeck();
  friction_.load(table.friction);
  friction_.weigh(law_.temperature_weights());
  torque_limit_Nm_ = config_.torque_limit_with(table);
}

void JointController::start(double position_rad, double velocity_rad_s,
                            std::optional<double> holding_torque_Nm) noexcept {
  plan_.start(position_rad, velocity_rad_s);
  rest_periods_ = 0;
  reading_.reset(position_rad, velocity_rad_s);
  law_.begin_anew();
  oscillation_.reset();
  const double gravity_Nm = config_.gravity.at(position_rad);
  if (holding_torque_Nm) friction_.set_load(*holding_torque_Nm - gravity_Nm);
  hold_torque_Nm_ = gravity_Nm + friction_.load_Nm();
  shown_load_Nm_ = friction_.load_Nm();
  phase_ = velocity_rad_s == 0.0 ? MotionPhase::kResting : MotionPhase::kTracking;
}

void JointController::yield(double load_Nm) noexcept {
  plan_.stop();
  yielding_ = {load_Nm, reading_.position_rad(), 0};
  law_.interrupt();
  phase_ = MotionPhase::kYielding;
}

double JointController::holding_torque_Nm() const noexcept {
  return shown_load_Nm_ + config_.gravity.at(plan_.now().link_position_rad) +
         plan_.trajectory().load().torque_Nm;
}

PlannedJoint JointController::joint() const noexcept {
  PlannedJoint joint{model_, friction_.load_Nm(), torque_limit_Nm_};
  joint.model.inertia_kgm2 += plan_.trajectory().load().inertia_kgm2;
  joint.model.friction = friction_.friction();
  return joint;
}

}  // namespace strainwave
