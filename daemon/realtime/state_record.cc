// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/state_record.h"

#include <algorithm>
#include <limits>

namespace strainwave {

namespace {

void fill_motion(const JointCycle& cycle, state_v1& state) noexcept {
  const bool controlled = cycle.mode.controlled();
  const JointStep& motion = cycle.motion;
  const double position_rad = cycle.zero.to_joint_rad(cycle.reading.joint_position_rad);
  state.setpoint_position_rad =
      controlled ? cycle.zero.to_joint_rad(motion.ordered_reference.position_rad) : position_rad;
  state.setpoint_velocity_rad_s = controlled ? motion.ordered_reference.velocity_rad_s : 0.0;
  state.target_position_rad =
      controlled ? cycle.ordered.shown_rad(cycle.target_rad, cycle.zero) : position_rad;
  state.joint_position_rad = position_rad;
  state.link_position_rad = cycle.reading.has_link_position
                                ? cycle.zero.to_joint_rad(cycle.reading.link_position_rad)
                                : std::numeric_limits<double>::quiet_NaN();
  const auto path = cycle.ordered.path();
  state.path_time_s = path ? path->time_s : std::numeric_limits<double>::quiet_NaN();
  state.inertia_estimated_kgm2 = cycle.inertia_kgm2.value_or(std::numeric_limits<double>::quiet_NaN());
  state.joint_velocity_rad_s = cycle.joint_velocity_rad_s;
  state.torque_commanded_Nm = controlled ? motion.output.torque_Nm : 0.0;
  state.torque_applied_Nm = cycle.reading.torque_applied_Nm;
  state.torque_feedback_Nm = motion.output.feedback_torque_Nm;
  state.torque_feedforward_Nm = motion.output.feedforward_torque_Nm;
  state.zero_velocity_weight = motion.output.zero_velocity_weight;
  state.gains_in_use = static_cast<std::int32_t>(motion.gains_in_use);
}

void fill_yield(const std::optional<Yield>& yield, state_v1& state) noexcept {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  state.yield_load_Nm = yield ? yield->load_Nm : kNone;
  state.yield_limit_Nm = yield ? yield->limit_Nm : kNone;
  state.yield_position_rad = yield ? yield->position_rad : kNone;
}

void fill_friction(const JointCycle& cycle, state_v1& state) noexcept {
  state.rule_count = cycle.friction_rules != nullptr ? cycle.friction_rules->rule_count : 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.rule_count); ++i)
    state.friction_rule_C[i] = cycle.friction_rules->rules[i].center_C;
  state.friction_factor = cycle.friction_factor;
  state.friction_learned_C = cycle.friction.learned_C;
  state.friction_age_s = cycle.friction.age_s(cycle.time.now_ns);
  state.friction_frozen = cycle.friction.frozen ? 1 : 0;
  std::copy(cycle.learned.scale.begin(), cycle.learned.scale.end(), state.friction_scales);
  state.learned_load_Nm = cycle.learned.load_Nm;
  state.late_samples = cycle.late_samples;
}

}  // namespace

void fill_record(const JointCycle& cycle, StateRecord& record) noexcept {
  state_v1& state = record.state;
  state.cycle = cycle.time.cycle;
  state.table_id = cycle.table_id;
  fill_motion(cycle, state);
  fill_yield(cycle.yield, state);
  fill_friction(cycle, state);
  state.temperature_used_C =
      cycle.temperature.known() ? cycle.temperature.used_C() : std::numeric_limits<double>::quiet_NaN();
  std::copy(cycle.weights.weight.begin(), cycle.weights.weight.end(), state.temperature_weights);
  state.temperature_status = static_cast<std::int32_t>(cycle.temperature.status());
  state.mode = static_cast<std::int32_t>(cycle.mode.mode());
  state.fault = static_cast<std::int32_t>(cycle.mode.fault());
  state.notices = cycle.notices;
  state.faults_total = cycle.mode.faults_total();
  // The drive may forget; what it said when the fault came is what explains it.
  state.drive_error = cycle.mode.is(Mode::kFaulted) ? cycle.mode.drive_error() : cycle.reading.drive_error;
  record.friction_rules_id = cycle.friction_rules_id;
  record.temperature_measured_C = cycle.temperature.measured_C();
  record.temperature_age_s = cycle.temperature.age_s(cycle.time.now_ns);
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
  sample.gains_in_use = static_cast<std::uint8_t>(state.gains_in_use);
  sample.temperature_status = static_cast<std::uint8_t>(state.temperature_status);
  sample.drive_state = static_cast<std::uint8_t>(drive_state);
  sample.reading_fresh = reading_fresh ? 1 : 0;
  return sample;
}

}  // namespace strainwave
