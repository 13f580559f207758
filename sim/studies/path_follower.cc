// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/path_follower.h"

#include <cmath>

#include "sim/studies/loop_controllers.h"

namespace strainwave {

namespace {

constexpr int kInterval = 10;       // periods between two samples of the stream
constexpr double kRounding = 1e-9;  // keeps a rounding error from adding a period

}  // namespace

StreamedController::StreamedController(const JointControllerConfig& config, const GainTable& table,
                                       const SmoothPath& path, const Told& told) noexcept
    : config_(config), table_(table), path_(path), told_(told), controller_(config) {
  controller_.load(table_);
}

void StreamedController::send(double time_s) noexcept {
  const int ahead =
      kInterval + static_cast<int>(std::ceil(controller_.plan().lead_s() / config_.period_s - kRounding));
  const Reference then = path_.at(time_s + ahead * config_.period_s);
  controller_.follow({then.position_rad, then.velocity_rad_s, then.acceleration_rad_s2, 2, ahead},
                     periods_ == 0, 0.0, {});
}

JointStep StreamedController::step(const LoopSample& sample) noexcept {
  if (periods_ == 0) controller_.start(sample.joint_position_rad);
  if (periods_ % kInterval == 0) send(sample.time_s);
  ++periods_;
  JointMeasurement measurement =
      measurement_of(sample, told_.fixed_C.value_or(sample.temperature_C + told_.shift_C));
  if (config_.drive_closes_loop()) measurement.drive_torque_Nm = sample.torque_applied_Nm;
  return controller_.step(measurement);
}

double StreamedController::torque_Nm(const LoopSample& sample) noexcept {
  const JointStep step = this->step(sample);
  off_ = off_ || step.oscillates;
  return off_ ? 0.0 : step.output.torque_Nm;
}

void StreamedController::reset() noexcept {
  controller_ = JointController(config_);
  controller_.load(table_);
  off_ = false;
  periods_ = 0;
}

// Each quantity belongs to its own instant: the position to its reading, the velocity to the middle of its
// difference. The acceleration belongs to the middle of the period over which the torque acts.
double PeerOnPath::torque_Nm(const LoopSample& sample) noexcept {
  if (!started_) peer_->reset(sample.joint_position_rad);
  started_ = true;
  const double acting_s = (joint_.delay_periods + 0.5) * joint_.period_s;
  const Reference reference{path_.at(sample.time_s).position_rad,
                            path_.at(sample.time_s - 0.5 * joint_.period_s).velocity_rad_s,
                            path_.at(sample.time_s + acting_s).acceleration_rad_s2};
  return peer_->step(reference, sample.joint_position_rad);
}

}  // namespace strainwave
