// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/gain_table_message.h"

#include <algorithm>
#include <cstring>

namespace strainwave {

namespace {

// One list of fields serves both directions: `copy(a, b)` copies the table's field to the message's or back.
template <typename Copy, typename Gains, typename GainsMessage>
void visit_gains(const Copy& copy, Gains& gains, GainsMessage& message) {
  copy(gains.controller.bytes, message.controller);
  copy(gains.has_integrator, message.has_integrator);
  copy(gains.rule_count, message.rule_count);
  copy(gains.weights.integral, message.weight_integral);
  copy(gains.weights.position, message.weight_position);
  copy(gains.weights.velocity, message.weight_velocity);
  copy(gains.weights.torque, message.weight_torque);
  copy(gains.decay_rate, message.decay_rate);
  copy(gains.cost_bound, message.cost_bound);
  copy(gains.F, message.F);
  copy(gains.P, message.P);
}

template <typename Copy, typename Friction, typename Message>
void visit_friction(const Copy& copy, Friction& friction, Message& message) {
  copy(friction.rule_count, message.temperature_rule_count);
  for (std::size_t i = 0; i < friction.rules.size(); ++i) {
    copy(friction.rules[i].center_C, message.rule_center_C[i]);
    copy(friction.rules[i].width_C, message.rule_width_C[i]);
    copy(friction.rules[i].friction.static_Nm, message.rule_static_Nm[i]);
    copy(friction.rules[i].friction.coulomb_Nm, message.rule_coulomb_Nm[i]);
    copy(friction.rules[i].friction.viscous_Nms_rad, message.rule_viscous_Nms_rad[i]);
  }
  copy(friction.velocity.zero_center_rad_s, message.zero_center_rad_s);
  copy(friction.velocity.zero_width_rad_s, message.zero_width_rad_s);
  copy(friction.velocity.high_center_rad_s, message.high_center_rad_s);
  copy(friction.velocity.high_width_rad_s, message.high_width_rad_s);
  copy(friction.temperature_min_C, message.temperature_min_C);
  copy(friction.temperature_max_C, message.temperature_max_C);
}

template <typename Copy, typename Range, typename Pair>
void visit_range(const Copy& copy, Range& range, Pair& pair) {
  copy(range.from, pair[0]);
  copy(range.to, pair[1]);
}

template <typename Copy, typename Box, typename Message>
void visit_box(const Copy& copy, Box& box, Message& message) {
  copy(box.encoder_side, message.encoder_side);
  visit_range(copy, box.motor_inertia_kgm2, message.box_motor_inertia_kgm2);
  visit_range(copy, box.link_inertia_kgm2, message.box_link_inertia_kgm2);
  visit_range(copy, box.stiffness_Nm_rad, message.box_stiffness_Nm_rad);
  visit_range(copy, box.damping_Nms_rad, message.box_damping_Nms_rad);
  copy(box.least_delay, message.box_delay_periods[0]);
  copy(box.most_delay, message.box_delay_periods[1]);
  copy(box.lead_periods, message.box_lead_periods);
  copy(box.cell_count, message.box_cell_count);
  for (std::size_t i = 0; i < box.cells.size(); ++i) {
    copy(box.cells[i].delay_periods, message.box_cells[i].delay_periods);
    visit_range(copy, box.cells[i].stiffness_Nm_rad, message.box_cells[i].stiffness_Nm_rad);
    visit_range(copy, box.cells[i].link_inertia_kgm2, message.box_cells[i].link_inertia_kgm2);
    copy(box.cells[i].P, message.box_cells[i].P);
  }
}

template <typename Copy, typename Table, typename Message>
void visit_table(const Copy& copy, Table& table, Message& message) {
  copy(table.format, message.format);
  copy(table.name.bytes, message.name);
  copy(table.plant.joint_model.bytes, message.joint_model);
  copy(table.plant.gear.bytes, message.gear);
  copy(table.plant.inertia_kgm2, message.inertia_kgm2);
  copy(table.plant.gear_ratio, message.gear_ratio);
  copy(table.plant.period_s, message.period_s);
  visit_box(copy, table.box, message);
  visit_friction(copy, table.friction, message);
  copy(table.torque_limit_Nm, message.torque_limit_Nm);
  visit_gains(copy, table.primary, message.primary);
  copy(table.provenance.sampling, message.sampling);
  copy(table.provenance.created_utc.bytes, message.created_utc);
  copy(table.provenance.tool.bytes, message.tool);
  copy(table.provenance.friction_sha256.bytes, message.friction_sha256);
  copy(table.provenance.note.bytes, message.note);
}

// Both sides are plain numbers or arrays of the same size in bytes.
struct TableToMessage {
  template <typename From, typename To>
  void operator()(const From& from, To& to) const {
    static_assert(sizeof(From) == sizeof(To));
    std::memcpy(&to, &from, sizeof(To));
  }
};
struct MessageToTable {
  template <typename To, typename From>
  void operator()(To& to, const From& from) const {
    static_assert(sizeof(From) == sizeof(To));
    std::memcpy(&to, &from, sizeof(To));
  }
};

}  // namespace

gain_table_v1 to_message(const GainTable& table) {
  gain_table_v1 message{};
  visit_table(TableToMessage{}, table, message);
  return message;
}

GainTable to_gain_table(const gain_table_v1& message) {
  GainTable table;
  visit_table(MessageToTable{}, table, message);
  return table;
}

}  // namespace strainwave
