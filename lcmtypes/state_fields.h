// SPDX-License-Identifier: BSD-3-Clause
// Every field of a state message under its own name. A test compares it with lcmtypes/state_v1.lcm. Not real-time.
#pragma once

#include <span>
#include <strainwave/state_v1.hpp>
#include <type_traits>

#include "lcmtypes/cycle_fields.h"

namespace strainwave {

/// Calls visit(name, value) for each field in the message's order; an array comes as a span of double.
template <typename Visit>
void visit_state_fields(const state_v1& state, Visit&& visit) {
  visit("utime", state.utime);
  visit("session_id", state.session_id);
  visit("challenge", state.challenge);
  visit("owner_id", state.owner_id);
  visit("lease_s", state.lease_s);
  visit_cycle_fields(state, [&](const FieldName& field, const auto& value) {
    if constexpr (std::is_array_v<std::remove_cvref_t<decltype(value)>>)
      visit(field.name.data(), std::span<const double>(value));
    else
      visit(field.name.data(), value);
  });
  visit("inertia_estimated_kgm2", state.inertia_estimated_kgm2);
  visit("link_position_rad", state.link_position_rad);
  visit("path_time_s", state.path_time_s);
  visit("yield_load_Nm", state.yield_load_Nm);
  visit("yield_limit_Nm", state.yield_limit_Nm);
  visit("yield_position_rad", state.yield_position_rad);
  visit("friction_factor", state.friction_factor);
  visit("friction_learned_C", state.friction_learned_C);
  visit("friction_age_s", state.friction_age_s);
  visit("friction_frozen", state.friction_frozen);
  visit("friction_rule_C", std::span<const double>(state.friction_rule_C));
  visit("friction_scales", std::span<const double>(state.friction_scales));
  visit("late_samples", state.late_samples);
  visit("torque_limit_Nm", state.torque_limit_Nm);
  visit("temperature_margin_C", state.temperature_margin_C);
  visit("learned_load_Nm", state.learned_load_Nm);
}

}  // namespace strainwave
