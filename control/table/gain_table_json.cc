// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table_json.h"

#include <array>
#include <span>

#include "base/input_error.h"
#include "base/json_fields.h"
#include "base/text_file.h"
#include "control/friction/friction_json.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

namespace {

constexpr Range kAny{-kMost, kMost};
// Largest static friction as a share of the torque limit: with more, friction takes more torque than it leaves for motion. The coldest
// rule of the catalogue's joint has 0.17.
constexpr double kMaxStaticShare = 0.5;

}  // namespace

template <typename Json>
void fields(Json& json, PlantIdentity& plant) {
  json("joint_model", plant.joint_model);
  json.require(!plant.joint_model.view().empty(), "joint_model", "named");
  json("gear", plant.gear);
  ranged(json, "inertia_kgm2", plant.inertia_kgm2, kPositive);
  ranged(json, "gear_ratio", plant.gear_ratio, kPositive);
  ranged(json, "period_s", plant.period_s, kPositive);
  if (plant.gear.view().empty()) return;
  const Gear* gear = find_gear(plant.gear.view());
  json.require(gear != nullptr, "gear", "empty or one of " + gear_names());
  json.require(gear == nullptr || is_same_number(plant.gear_ratio, gear->ratio), "gear",
               "a gear of gear_ratio = " + number_text(plant.gear_ratio));
}

template <typename Json>
void fields(Json& json, CostWeights& weights) {
  ranged(json, "integral", weights.integral, kZeroOrMore);
  ranged(json, "position", weights.position, kPositive);
  ranged(json, "velocity", weights.velocity, kZeroOrMore);
  ranged(json, "torque", weights.torque, kPositive);
}

template <typename Json>
void fields(Json& json, FeedbackGains& gains) {
  json("controller", gains.controller);
  bool has_integrator = gains.has_integrator != 0;
  json("has_integrator", has_integrator);
  gains.has_integrator = has_integrator ? 1 : 0;
  json("weights", gains.weights);
  json.require((gains.weights.integral > 0.0) == has_integrator, "weights",
               "with integral above 0 if has_integrator is true, and 0 otherwise");
  ranged(json, "decay_rate", gains.decay_rate, {1e-9, 1.0});
  ranged(json, "cost_bound", gains.cost_bound, kZeroOrMore);
  json.list("rules", gains.rule_count, 1, kMaxRules, [&](auto& rule, std::size_t j) {
    ranged(rule, "F", gains.F[j], kAny);
    rule.matrix("P", gains.P[j], kMaxStates);
    const StateMatrix P = gains.lyapunov(static_cast<int>(j));
    rule.require(kAny.holds_all(gains.P[j]), "P", kAny.text());
    rule.require(P == P.transpose(), "P", "symmetric");
    rule.require(has_integrator || (gains.F[j][0] == 0.0 && P.row(0).isZero(0.0)), "P",
                 "0 in the integral's row without an integrator, like F");
  });
  const bool scheduled = gains.scheduled();
  const char* const expected = has_integrator ? (scheduled ? "C4" : "C3") : (scheduled ? "C2" : "C1");
  json.require(gains.controller.view() == expected, "controller",
               std::string(expected) + " for these states and this number of rules");
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
void range_field(Json& json, const std::string& key, BoxRange& range, Range allowed = kPositive) {
  std::array ends{range.from, range.to};
  ranged(json, key, ends, allowed);
  json.require(ends[0] <= ends[1], key, "in rising order");
  range = {ends[0], ends[1]};
}

template <typename Json>
void cell_fields(Json& json, const CertifiedBox& box, BoxCell& cell) {
  ranged(json, "delay_periods", cell.delay_periods,
         {static_cast<double>(box.least_delay), static_cast<double>(box.most_delay)});
  if (!box.rigid()) {
    range_field(json, "stiffness_Nm_rad", cell.stiffness_Nm_rad);
    range_field(json, "link_inertia_kgm2", cell.link_inertia_kgm2);
  }
  const std::span<double> P = std::span(cell.P).first(box.entries_of(cell));
  json.numbers("P", P);
  json.require(kAny.holds_all(P), "P", kAny.text());
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
    range_field(json, "damping_Nms_rad", box.damping_Nms_rad, kZeroOrMore);
  }
  std::array delays{box.least_delay, box.most_delay};
  ranged(json, "delay_periods", delays, {0.0, kMaxBoxDelay});
  json.require(delays[0] <= delays[1], "delay_periods", "in rising order");
  box.least_delay = delays[0];
  box.most_delay = delays[1];
  if (spring) {
    std::optional<double> lead_periods;
    if (box.lead_periods != 0.0) lead_periods = box.lead_periods;
    json("lead_periods", lead_periods);
    box.lead_periods = lead_periods.value_or(0.0);
    json.require(Range{0.0, kMaxLeadPeriods}.holds(box.lead_periods), "lead_periods",
                 "from 0 to " + number_text(kMaxLeadPeriods));
  }
  json.list("cells", box.cell_count, spring ? 1 : 0, kMaxBoxCells,
            [&](auto& cell, std::size_t i) { cell_fields(cell, box, box.cells[i]); });
}

namespace {

// Friction is fed forward in addition to the certified feedback. It must be physical, and less than the motor can give.
template <typename Json>
void require_physical(Json& json, const std::string& path, const FuzzyFriction& friction,
                      double torque_limit_Nm) {
  for (int i = 0; i < friction.rule_count; ++i) {
    const auto& [static_Nm, coulomb_Nm, viscous_Nms_rad] =
        friction.rules[static_cast<std::size_t>(i)].friction;
    const auto require = [&](const char* key, double value, Range range, const char* why) {
      json.require(range.holds(value),
                   path + "rules[" + std::to_string(i) + "]." + key + " = " + number_text(value),
                   range.text() + why);
    };
    require("static_Nm", static_Nm, {0.0, kMaxStaticShare * torque_limit_Nm}, ", half of torque_limit_Nm");
    require("coulomb_Nm", coulomb_Nm, {0.0, static_Nm}, ", static_Nm");
    require("viscous_Nms_rad", viscous_Nms_rad, kZeroOrMore, "");
  }
}

}  // namespace

template <typename Json>
void fields(Json& json, GainTable& table) {
  json.refuse("exponential", "holds fitted friction, not gains: strainwave-design gains makes a table of it");
  // The format is checked first, since another format has other keys.
  json.format(kGainTableFormat, "design the table again");
  json("name", table.name);
  json.require(!table.name.view().empty(), "name", "a name");
  json("plant", table.plant);
  json("box", table.box);
  json.require(table.box.rigid() || !table.plant.gear.view().empty(), "plant.gear",
               "named where the joint has a spring");
  json("friction", table.friction);
  ranged(json, "torque_limit_Nm", table.torque_limit_Nm, kPositive);
  require_physical(json, "friction.", table.friction, table.torque_limit_Nm);
  json("primary", table.primary);
  json.require(table.primary.rule_count == 1 || table.primary.rule_count == 1 + table.friction.rule_count,
               "primary.rules",
               "1 (temperature-free) or " + std::to_string(1 + table.friction.rule_count) +
                   ", one more than friction has");
  json("provenance", table.provenance);
}

std::string to_json(const GainTable& table) {
  return json_text(table);
}

// The table is written and read back. What differs then is hidden: no key names it.
std::optional<std::string> find_defect(const GainTable& table) {
  if (table.format != kGainTableFormat)
    return "format = " + std::to_string(table.format) + ": this program reads format " +
           std::to_string(kGainTableFormat);
  if (table.primary.has_integrator != 0 && table.primary.has_integrator != 1)
    return "primary.has_integrator = " + std::to_string(table.primary.has_integrator) + ": must be 0 or 1";
  try {
    if (from_document<GainTable>(to_document(table), "") == table) return std::nullopt;
    return "an unused place must be 0: beyond a count, after the end of a text, or of a spring in a rigid "
           "box (link_inertia_kgm2[1] = 0)";
  } catch (const InputError& error) {
    return error.what();
  }
}

void require_friction(const FuzzyFriction& friction, double torque_limit_Nm, const std::string& source) {
  try {
    JsonWriter writer("friction");
    FuzzyFriction checked = friction;
    fields(writer, checked);
    require_physical(writer, "", friction, torque_limit_Nm);
  } catch (const InputError& error) {
    throw InputError(source + ": " + error.what());
  }
}

GainTable gain_table_from_json(std::string_view text, const std::string& source) {
  return from_json_text<GainTable>(text, source);
}

GainTable read_gain_table(const std::filesystem::path& path) {
  return gain_table_from_json(read_text_file(path), path.string());
}

void write_gain_table(const GainTable& table, const std::filesystem::path& path) {
  if (const auto defect = find_defect(table)) throw InputError(path.string() + ": not written: " + *defect);
  write_text_file(path, to_json(table));
}

}  // namespace strainwave
