// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lcmtypes/oscillation_evidence.h"

namespace strainwave {

namespace {

/// So small an angle changes the torque of gravity by at most a hundredth of its amplitude.
constexpr double kSamePlace_rad = 0.01;
/// Tolerated standard deviations of the estimated inertia, in addition to kInertiaApart.
constexpr double kCertainDeviations = 3.0;

}  // namespace

JointLaw::JointLaw(const JointLoopConfig& config)
    : gravity_(config.controller.gravity),
      controller_(config.controller),
      inertia_({config.controller.period_s, count_of(config.controller), config.controller.delay_periods}),
      held_{config.initial_load_Nm, {}},
      closes_loop_(config.controller.drive_closes_loop()) {}

// Learned friction scales are valid only for the rules with which they were learned.
void JointLaw::use_table(const TableSlot& slot) noexcept {
  if (table_ != nullptr && table_->friction_rules_id != slot.friction_rules_id) forget_learned();
  controller_.load(slot.table);
  table_ = &slot;
}

// A joint that was moved meanwhile may carry another load, so only the configured gravity counts there.
double JointLaw::load_at_Nm(double position_rad) const noexcept {
  const double gravity_Nm = gravity_.at(position_rad);
  if (!held_.position_rad) return held_.torque_Nm + gravity_Nm;
  return std::abs(position_rad - *held_.position_rad) < kSamePlace_rad ? held_.torque_Nm : gravity_Nm;
}

void JointLaw::take_over(double position_rad, double velocity_rad_s) noexcept {
  controller_.start(position_rad, velocity_rad_s, load_at_Nm(position_rad));
  inertia_.forget();
}

void JointLaw::wait_for_brake(double position_rad) noexcept {
  if (position_rad == controller_.plan().rest_position_rad())
    controller_.start(position_rad, 0.0, load_at_Nm(position_rad));
}

void JointLaw::run(const JointDrive& drive, const CycleTime& time, bool brake_opens) noexcept {
  const ActuatorReading& reading = drive.reading();
  JointMeasurement measurement;
  measurement.joint_position_rad = reading.joint_position_rad;
  measurement.joint_velocity_rad_s = reading.joint_velocity_rad_s;
  measurement.temperature_C = drive.temperature().used_C();
  measurement.has_position = drive.fresh();
  measurement.has_velocity = reading.has_velocity;
  measurement.temperature_valid = drive.temperature().known();
  measurement.late_periods = reading.position_late_periods;
  measurement.elapsed_periods =
      static_cast<int>(std::min<std::int64_t>(time.elapsed_periods, std::numeric_limits<int>::max()));
  if (closes_loop_ && reading.torque_measured) measurement.drive_torque_Nm = reading.torque_applied_Nm;
  estimate_inertia(measurement, brake_opens || closes_loop_);
  motion_ = controller_.step(measurement);
  if (motion_.learns) friction_.learned_now(measurement.temperature_C, time.now_ns);
}

// Uses the last commanded torque. A brake would hold the joint whatever this torque; a drive that closes its own loop applies another one.
void JointLaw::estimate_inertia(const JointMeasurement& measurement, bool other_torque) noexcept {
  if (!measurement.has_position || measurement.elapsed_periods != 1 || measurement.late_periods != 0 ||
      other_torque)
    return inertia_.interrupt();
  inertia_.step(
      {measurement.joint_position_rad, motion_.output.torque_Nm, gravity_.at(measurement.joint_position_rad)},
      controller_.joint().model);
}

void JointLaw::restore(const LearnedFriction& learned, const FrictionHistory& history) noexcept {
  controller_.friction().set(learned);
  friction_ = history;
}

void JointLaw::forget_learned() noexcept {
  // A drive that closes its own loop gets the load as feed-forward even at rest, so the load must not drop to zero at once.
  LearnedFriction none;
  if (closes_loop_) none.load_Nm = controller_.friction().load_Nm();
  controller_.friction().set(none);
  friction_ = {};
}

bool JointLaw::shows_other_inertia() const noexcept {
  const std::optional<double> shown_kgm2 = inertia_.inertia_kgm2();
  const double configured_kgm2 = controller_.joint().model.inertia_kgm2;
  return shown_kgm2 && std::abs(*shown_kgm2 - configured_kgm2) >
                           kInertiaApart * configured_kgm2 + kCertainDeviations * inertia_.deviation_kgm2();
}

std::uint32_t JointLaw::evidence() const noexcept {
  const OscillationDetector& seen = controller_.oscillation();
  const double configured_kgm2 = controller_.joint().model.inertia_kgm2;
  const double shown_kgm2 = inertia_.inertia_kgm2().value_or(0.0);
  return evidence_number({seen.reversals_per_s(), seen.swing_Nm(), shown_kgm2 / configured_kgm2});
}

}  // namespace strainwave
