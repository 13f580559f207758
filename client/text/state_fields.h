// Every field of a state message under its own name: the one list that CSV, JSON and the detailed status are
// made from. A test compares it with lcmtypes/state_v1.lcm. Not real-time.
#pragma once

#include <span>
#include <strainwave/state_v1.hpp>

namespace strainwave {

/// Calls visit(name, value) for each field in the message's order; an array comes as a span of double.
template <typename Visit>
void visit_state_fields(const state_v1& state, Visit&& visit) {
  visit("utime", state.utime);
  visit("session_id", state.session_id);
  visit("cycle", state.cycle);
  visit("table_id", state.table_id);
  visit("setpoint_position_rad", state.setpoint_position_rad);
  visit("setpoint_velocity_rad_s", state.setpoint_velocity_rad_s);
  visit("target_position_rad", state.target_position_rad);
  visit("joint_position_rad", state.joint_position_rad);
  visit("joint_velocity_rad_s", state.joint_velocity_rad_s);
  visit("torque_commanded_Nm", state.torque_commanded_Nm);
  visit("torque_applied_Nm", state.torque_applied_Nm);
  visit("torque_feedback_Nm", state.torque_feedback_Nm);
  visit("torque_feedforward_Nm", state.torque_feedforward_Nm);
  visit("temperature_C", state.temperature_C);
  visit("zero_velocity_weight", state.zero_velocity_weight);
  visit("temperature_weights", std::span<const double>(state.temperature_weights));
  visit("rule_count", state.rule_count);
  visit("mode", state.mode);
  visit("fault", state.fault);
  visit("notices", state.notices);
  visit("gains_in_use", state.gains_in_use);
  visit("temperature_status", state.temperature_status);
  visit("faults_total", state.faults_total);
  visit("drive_error", state.drive_error);
}

}  // namespace strainwave
