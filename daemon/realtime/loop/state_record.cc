// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/state_record.h"

#include <algorithm>
#include <limits>

namespace strainwave {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The controller's target, as the drive counts positions.
double target_rad(const JointInLoop& joint) noexcept {
  return joint.ordered.on_path() ? joint.zero.to_drive_rad(joint.path->path.last().position_rad)
                                 : joint.law.controller().plan().trajectory().target_rad();
}

void fill_motion(const JointInLoop& joint, state_v1& state) noexcept {
  const bool controlled = joint.mode.controlled();
  const JointStep& motion = joint.law.motion();
  const ActuatorReading& reading = joint.drive.reading();
  const double position_rad = joint.zero.to_joint_rad(reading.joint_position_rad);
  state.setpoint_position_rad =
      controlled ? joint.zero.to_joint_rad(motion.ordered_reference.position_rad) : position_rad;
  state.setpoint_velocity_rad_s = controlled ? motion.ordered_reference.velocity_rad_s : 0.0;
  state.target_position_rad =
      controlled ? joint.ordered.shown_rad(target_rad(joint), joint.zero) : position_rad;
  state.joint_position_rad = position_rad;
  state.link_position_rad =
      reading.has_link_position ? joint.zero.to_joint_rad(reading.link_position_rad) : kUnknown;
  const auto path = joint.ordered.path();
  state.path_time_s = path ? path->time_s : kUnknown;
  state.inertia_estimated_kgm2 = controlled ? joint.law.inertia_kgm2().value_or(kUnknown) : kUnknown;
  state.joint_velocity_rad_s = joint.velocity_rad_s();
  state.torque_commanded_Nm = controlled ? motion.output.torque_Nm : 0.0;
  state.torque_applied_Nm = reading.torque_applied_Nm;
  state.torque_feedback_Nm = motion.output.feedback_torque_Nm;
  state.torque_feedforward_Nm = motion.output.feedforward_torque_Nm;
  state.zero_velocity_weight = motion.output.zero_velocity_weight;
  state.yield_load_Nm = joint.yield ? joint.yield->load_Nm : kUnknown;
  state.yield_limit_Nm = joint.yield ? joint.yield->limit_Nm : kUnknown;
  state.yield_position_rad = joint.yield ? joint.yield->position_rad : kUnknown;
}

void fill_friction(const JointInLoop& joint, std::int64_t now_ns, StateRecord& record) noexcept {
  state_v1& state = record.state;
  state.table_id = record.friction_rules_id = state.rule_count = 0;
  if (const TableSlot* table = joint.law.table(); table != nullptr) {
    state.table_id = table->id;
    record.friction_rules_id = table->friction_rules_id;
    state.rule_count = table->table.friction.rule_count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.rule_count); ++i)
      state.friction_rule_C[i] = table->table.friction.rules[i].center_C;
  }
  const FrictionLearning& friction = joint.law.controller().friction();
  const FrictionHistory& history = joint.law.friction_history();
  state.friction_factor = friction.factor();
  state.friction_learned_C = history.learned_C;
  state.friction_age_s = history.age_s(now_ns);
  state.friction_frozen = friction.frozen() ? 1 : 0;
  std::copy(friction.learned().scale.begin(), friction.learned().scale.end(), state.friction_scales);
  state.learned_load_Nm = friction.learned().load_Nm;
}

}  // namespace

void fill_record(const JointInLoop& joint, const CycleTime& time, StateRecord& record) noexcept {
  state_v1& state = record.state;
  state.cycle = time.cycle;
  fill_motion(joint, state);
  fill_friction(joint, time.now_ns, record);
  const TemperatureCheck& temperature = joint.drive.temperature();
  state.temperature_used_C = temperature.known() ? temperature.used_C() : kUnknown;
  state.temperature_margin_C = temperature.margin_C(joint.config.limits.temperature_limit_C);
  state.torque_limit_Nm = joint.law.controller().joint().driving_Nm;
  const auto& weights = joint.law.controller().temperature_weights().weight;
  std::copy(weights.begin(), weights.end(), state.temperature_weights);
  state.temperature_status = static_cast<std::int32_t>(temperature.status());
  state.mode = static_cast<std::int32_t>(joint.mode.mode());
  state.fault = static_cast<std::int32_t>(joint.mode.fault());
  state.notices = joint.notices;
  state.faults_total = joint.mode.faults_total();
  state.late_samples = joint.stream.late_samples;
  // The drive may forget its error. The number that came with the fault explains it.
  state.drive_error =
      joint.mode.is(Mode::kFaulted) ? joint.mode.drive_error() : joint.drive.reading().drive_error;
  record.temperature_measured_C = temperature.measured_C();
  record.temperature_age_s = temperature.age_s(time.now_ns);
}

FlightSample flight_sample(const StateRecord& record, const CycleTime& time, DriveState drive_state,
                           bool reading_fresh) noexcept {
  const state_v1& state = record.state;
  FlightSample sample;
  sample.time_ns = time.now_ns;
  sample.cycle = time.cycle;
  sample.table_id = state.table_id;
  sample.setpoint_position_rad = state.setpoint_position_rad;
  sample.setpoint_velocity_rad_s = state.setpoint_velocity_rad_s;
  sample.target_position_rad = state.target_position_rad;
  sample.joint_position_rad = state.joint_position_rad;
  sample.joint_velocity_rad_s = state.joint_velocity_rad_s;
  sample.torque_commanded_Nm = state.torque_commanded_Nm;
  sample.torque_applied_Nm = state.torque_applied_Nm;
  sample.torque_feedback_Nm = state.torque_feedback_Nm;
  sample.torque_feedforward_Nm = state.torque_feedforward_Nm;
  sample.temperature_used_C = state.temperature_used_C;
  sample.temperature_measured_C = record.temperature_measured_C;
  sample.zero_velocity_weight = state.zero_velocity_weight;
  sample.drive_error = static_cast<std::uint32_t>(state.drive_error);
  sample.notices = static_cast<std::uint32_t>(state.notices);
  sample.mode = static_cast<std::uint8_t>(state.mode);
  sample.fault = static_cast<std::uint8_t>(state.fault);
  sample.temperature_status = static_cast<std::uint8_t>(state.temperature_status);
  sample.drive_state = static_cast<std::uint8_t>(drive_state);
  sample.reading_fresh = reading_fresh ? 1 : 0;
  return sample;
}

}  // namespace strainwave
