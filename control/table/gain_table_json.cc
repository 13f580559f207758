// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table_json.h"

#include <array>

#include "base/input_error.h"
#include "base/json_fields.h"
#include "base/text_file.h"
#include "control/friction/friction_json.h"

namespace strainwave {

template <typename Json>
void fields(Json& json, PlantIdentity& plant) {
  json("joint_model", plant.joint_model);
  json("gear", plant.gear);
  json("inertia_kgm2", plant.inertia_kgm2);
  json("gear_ratio", plant.gear_ratio);
  json("period_s", plant.period_s);
}

template <typename Json>
void fields(Json& json, CostWeights& weights) {
  json("integral", weights.integral);
  json("position", weights.position);
  json("velocity", weights.velocity);
  json("torque", weights.torque);
}

template <typename Json>
void fields(Json& json, FeedbackGains& gains) {
  json("controller", gains.controller);
  bool has_integrator = gains.has_integrator != 0;
  json("has_integrator", has_integrator);
  gains.has_integrator = has_integrator ? 1 : 0;
  json("weights", gains.weights);
  json("decay_rate", gains.decay_rate);
  json("cost_bound", gains.cost_bound);
  json.list("rules", gains.rule_count, 1, kMaxRules, [&](auto& rule, std::size_t j) {
    rule("F", gains.F[j]);
    rule.matrix("P", gains.P[j], kMaxStates);
  });
}

template <typename Json>
void fields(Json& json, Provenance& provenance) {
  json.name("sampling", provenance.sampling, std::array{"forward-euler", "zero-order-hold"});
  json("created_utc", provenance.created_utc);
  json("tool", provenance.tool);
  json("friction_sha256", provenance.friction_sha256);
  json("note", provenance.note);
}

namespace {

template <typename Json>
void range_field(Json& json, const std::string& key, BoxRange& range) {
  std::array ends{range.from, range.to};
  json(key, ends);
  range = {ends[0], ends[1]};
}

template <typename Json>
void require_delay(Json& json, std::int32_t periods) {
  json.require(periods >= 0 && periods <= kMaxBoxDelay, "delay_periods",
               "whole periods from 0 to " + std::to_string(kMaxBoxDelay));
}

template <typename Json>
void cell_fields(Json& json, const CertifiedBox& box, BoxCell& cell) {
  json("delay_periods", cell.delay_periods);
  require_delay(json, cell.delay_periods);
  if (!box.rigid()) {
    range_field(json, "stiffness_Nm_rad", cell.stiffness_Nm_rad);
    range_field(json, "link_inertia_kgm2", cell.link_inertia_kgm2);
  }
  json.numbers("P", std::span(cell.P).first(box.entries_of(cell)));
}

}  // namespace

template <typename Json>
void fields(Json& json, CertifiedBox& box) {
  bool spring = !box.rigid();
  json.name("joint", spring, std::array{"rigid", "spring"});
  json.name("encoder_side", box.encoder_side,
            std::array{to_text(EncoderSide::kMotor), to_text(EncoderSide::kLink)});
  if (spring) {
    range_field(json, "motor_inertia_kgm2", box.motor_inertia_kgm2);
    range_field(json, "link_inertia_kgm2", box.link_inertia_kgm2);
    range_field(json, "stiffness_Nm_rad", box.stiffness_Nm_rad);
    range_field(json, "damping_Nms_rad", box.damping_Nms_rad);
  }
  std::array delays{box.least_delay, box.most_delay};
  json("delay_periods", delays);
  for (const std::int32_t delay : delays) require_delay(json, delay);
  box.least_delay = delays[0];
  box.most_delay = delays[1];
  if (spring) {
    std::optional<double> lead_periods;
    if (box.lead_periods != 0.0) lead_periods = box.lead_periods;
    json("lead_periods", lead_periods);
    box.lead_periods = lead_periods.value_or(0.0);
  }
  json.list("cells", box.cell_count, spring ? 1 : 0, kMaxBoxCells,
            [&](auto& cell, std::size_t i) { cell_fields(cell, box, box.cells[i]); });
}

template <typename Json>
void fields(Json& json, GainTable& table) {
  json.refuse("exponential", "holds fitted friction, not gains: strainwave-design gains makes a table of it");
  // The format first: another one has other keys.
  json.format(kGainTableFormat, "design the table again");
  json("name", table.name);
  json("plant", table.plant);
  json("box", table.box);
  json("friction", table.friction);
  json("torque_limit_Nm", table.torque_limit_Nm);
  json("primary", table.primary);
  json("provenance", table.provenance);
}

std::string to_json(const GainTable& table) {
  return json_text(table);
}

GainTable gain_table_from_json(std::string_view text, const std::string& source) {
  const auto table = from_json_text<GainTable>(text, source);
  if (const auto defect = find_defect(table)) throw InputError(source + ": " + *defect);
  return table;
}

GainTable read_gain_table(const std::filesystem::path& path) {
  return gain_table_from_json(read_text_file(path), path.string());
}

void write_gain_table(const GainTable& table, const std::filesystem::path& path) {
  if (const auto defect = find_defect(table)) throw InputError(path.string() + ": not written: " + *defect);
  write_text_file(path, to_json(table));
}

}  // namespace strainwave
