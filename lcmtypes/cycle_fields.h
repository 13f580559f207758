// SPDX-License-Identifier: BSD-3-Clause
// The list of all fields that state messages and flight records have for one joint and cycle, with names and units. Programs that
// write, print or draw them visit this one list. Real-time safe if the visitor is.
#pragma once

#include <string_view>

namespace strainwave {

/// Format number of flight records; it changes with the list of fields. daemon/records writes it, client/text reads it.
inline constexpr int kFlightRecordFormat = 1;

struct FieldName {
  std::string_view name;
  std::string_view unit;  ///< "1" for counts, numbers, bit sets and shares
};

/// Calls visit(FieldName, value) for each field that `cycle` has, in this order. Fields that `cycle` lacks are omitted.
template <typename Cycle, typename Visit>
constexpr void visit_cycle_fields(const Cycle& cycle, Visit&& visit) {
  visit(FieldName{"cycle", "1"}, cycle.cycle);
  visit(FieldName{"table_id", "1"}, cycle.table_id);
  visit(FieldName{"setpoint_position_rad", "rad"}, cycle.setpoint_position_rad);
  visit(FieldName{"setpoint_velocity_rad_s", "rad/s"}, cycle.setpoint_velocity_rad_s);
  visit(FieldName{"target_position_rad", "rad"}, cycle.target_position_rad);
  visit(FieldName{"joint_position_rad", "rad"}, cycle.joint_position_rad);
  visit(FieldName{"joint_velocity_rad_s", "rad/s"}, cycle.joint_velocity_rad_s);
  visit(FieldName{"torque_commanded_Nm", "N.m"}, cycle.torque_commanded_Nm);
  visit(FieldName{"torque_applied_Nm", "N.m"}, cycle.torque_applied_Nm);
  visit(FieldName{"torque_feedback_Nm", "N.m"}, cycle.torque_feedback_Nm);
  visit(FieldName{"torque_feedforward_Nm", "N.m"}, cycle.torque_feedforward_Nm);
  visit(FieldName{"temperature_used_C", "degC"}, cycle.temperature_used_C);
  if constexpr (requires { cycle.temperature_measured_C; })
    visit(FieldName{"temperature_measured_C", "degC"}, cycle.temperature_measured_C);
  visit(FieldName{"zero_velocity_weight", "1"}, cycle.zero_velocity_weight);
  if constexpr (requires { cycle.temperature_weights; })
    visit(FieldName{"temperature_weights", "1"}, cycle.temperature_weights);
  if constexpr (requires { cycle.rule_count; }) visit(FieldName{"rule_count", "1"}, cycle.rule_count);
  visit(FieldName{"mode", "1"}, cycle.mode);
  visit(FieldName{"fault", "1"}, cycle.fault);
  visit(FieldName{"notices", "1"}, cycle.notices);
  visit(FieldName{"temperature_status", "1"}, cycle.temperature_status);
  if constexpr (requires { cycle.faults_total; }) visit(FieldName{"faults_total", "1"}, cycle.faults_total);
  visit(FieldName{"drive_error", "1"}, cycle.drive_error);
  if constexpr (requires { cycle.drive_state; }) visit(FieldName{"drive_state", "1"}, cycle.drive_state);
  if constexpr (requires { cycle.reading_fresh; })
    visit(FieldName{"reading_fresh", "1"}, cycle.reading_fresh);
}

/// Returns the position setpoint of a cycle minus the measured position.
template <typename Cycle>
constexpr double tracking_error_rad(const Cycle& cycle) {
  return cycle.setpoint_position_rad - cycle.joint_position_rad;
}

}  // namespace strainwave
