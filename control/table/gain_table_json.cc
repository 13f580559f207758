// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "base/input_error.h"
#include "base/strict_json.h"
#include "base/text_file.h"
#include "control/friction/friction_json.h"

namespace strainwave {

using nlohmann::ordered_json;

namespace {

constexpr std::array kSamplings{"forward-euler", "zero-order-hold"};

ordered_json plant_to_json(const PlantIdentity& plant) {
  return {{"joint_model", plant.joint_model.view()},
          {"gear", plant.gear.view()},
          {"inertia_kgm2", plant.inertia_kgm2},
          {"gear_ratio", plant.gear_ratio},
          {"period_s", plant.period_s}};
}

ordered_json gains_to_json(const FeedbackGains& gains) {
  ordered_json rules = ordered_json::array();
  for (std::size_t j = 0; j < static_cast<std::size_t>(gains.rule_count); ++j) {
    const auto& P = gains.P[j];
    ordered_json rows = ordered_json::array();
    for (std::size_t a = 0; a < kMaxStates; ++a) rows.push_back({P[3 * a], P[3 * a + 1], P[3 * a + 2]});
    rules.push_back({{"F", gains.F[j]}, {"P", std::move(rows)}});
  }
  return {{"controller", gains.controller.view()},
          {"has_integrator", gains.has_integrator != 0},
          {"weights",
           {{"integral", gains.weights.integral},
            {"position", gains.weights.position},
            {"velocity", gains.weights.velocity},
            {"torque", gains.weights.torque}}},
          {"decay_rate", gains.decay_rate},
          {"cost_bound", gains.cost_bound},
          {"rules", std::move(rules)}};
}

ordered_json provenance_to_json(const Provenance& provenance) {
  const bool euler = provenance.sampling == Sampling::kForwardEuler;
  return {{"sampling", kSamplings[euler ? 0 : 1]},
          {"created_utc", provenance.created_utc.view()},
          {"tool", provenance.tool.view()},
          {"friction_sha256", provenance.friction_sha256.view()},
          {"note", provenance.note.view()}};
}

constexpr std::array kJoints{"rigid", "spring"};

ordered_json range_to_json(const BoxRange& range) {
  return {range.from, range.to};
}

ordered_json cell_to_json(const CertifiedBox& box, const BoxCell& cell) {
  ordered_json document = {{"delay_periods", cell.delay_periods}};
  if (!box.rigid()) {
    document["stiffness_Nm_rad"] = range_to_json(cell.stiffness_Nm_rad);
    document["link_inertia_kgm2"] = range_to_json(cell.link_inertia_kgm2);
  }
  const auto P = std::span(cell.P).first(box.entries_of(cell));
  document["P"] = std::vector<double>(P.begin(), P.end());
  return document;
}

ordered_json box_to_json(const CertifiedBox& box) {
  ordered_json document = {{"joint", kJoints[box.rigid() ? 0 : 1]},
                           {"encoder_side", to_text(box.encoder_side)}};
  if (!box.rigid()) {
    document["motor_inertia_kgm2"] = range_to_json(box.motor_inertia_kgm2);
    document["link_inertia_kgm2"] = range_to_json(box.link_inertia_kgm2);
    document["stiffness_Nm_rad"] = range_to_json(box.stiffness_Nm_rad);
    document["damping_Nms_rad"] = range_to_json(box.damping_Nms_rad);
  }
  document["delay_periods"] = {box.least_delay, box.most_delay};
  if (box.lead_periods != 0.0) document["lead_periods"] = box.lead_periods;
  document["cells"] = ordered_json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(box.cell_count); ++i)
    document["cells"].push_back(cell_to_json(box, box.cells[i]));
  return document;
}

/// One of two names.
bool is_first(StrictObject& object, const std::string& key, const std::array<const char*, 2>& names) {
  const std::string value = object.text(key, 32);
  if (value != names[0] && value != names[1])
    throw InputError(object.where(key) + " = " + value + ": must be " + names[0] + " or " + names[1]);
  return value == names[0];
}

BoxRange range_from_json(StrictObject& object, const std::string& key) {
  const std::vector<double> ends = object.numbers(key, 2);
  return {ends[0], ends[1]};
}

std::int32_t delay_from_number(const StrictObject& object, double value) {
  if (value >= 0.0 && value <= kMaxBoxDelay && value == std::floor(value))
    return static_cast<std::int32_t>(value);
  throw InputError(object.where("delay_periods") + ": must be whole periods from 0 to " +
                   std::to_string(kMaxBoxDelay));
}

BoxCell cell_from_json(StrictObject& object, const CertifiedBox& box) {
  BoxCell cell;
  cell.delay_periods = delay_from_number(object, object.number("delay_periods"));
  if (!box.rigid()) {
    cell.stiffness_Nm_rad = range_from_json(object, "stiffness_Nm_rad");
    cell.link_inertia_kgm2 = range_from_json(object, "link_inertia_kgm2");
  }
  std::ranges::copy(object.numbers("P", box.entries_of(cell)), cell.P.begin());
  object.finish();
  return cell;
}

CertifiedBox box_from_json(StrictObject object) {
  CertifiedBox box;
  const bool rigid = is_first(object, "joint", kJoints);
  const bool motor =
      is_first(object, "encoder_side", {to_text(EncoderSide::kMotor), to_text(EncoderSide::kLink)});
  box.encoder_side = motor ? EncoderSide::kMotor : EncoderSide::kLink;
  if (!rigid) {
    box.motor_inertia_kgm2 = range_from_json(object, "motor_inertia_kgm2");
    box.link_inertia_kgm2 = range_from_json(object, "link_inertia_kgm2");
    box.stiffness_Nm_rad = range_from_json(object, "stiffness_Nm_rad");
    box.damping_Nms_rad = range_from_json(object, "damping_Nms_rad");
    if (object.has("lead_periods")) box.lead_periods = object.number("lead_periods");
  }
  const BoxRange delays = range_from_json(object, "delay_periods");
  box.least_delay = delay_from_number(object, delays.from);
  box.most_delay = delay_from_number(object, delays.to);
  std::vector<StrictObject> cells = object.objects("cells", rigid ? 0 : 1, kMaxBoxCells);
  box.cell_count = static_cast<std::int32_t>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) box.cells[i] = cell_from_json(cells[i], box);
  object.finish();
  return box;
}

template <std::size_t N>
FixedString<N> text_field(StrictObject& object, const std::string& key) {
  return FixedString<N>(object.text(key, N - 1));
}

PlantIdentity plant_from_json(StrictObject object) {
  PlantIdentity plant;
  plant.joint_model = text_field<32>(object, "joint_model");
  plant.gear = text_field<32>(object, "gear");
  plant.inertia_kgm2 = object.number("inertia_kgm2");
  plant.gear_ratio = object.number("gear_ratio");
  plant.period_s = object.number("period_s");
  object.finish();
  return plant;
}

CostWeights weights_from_json(StrictObject object) {
  CostWeights weights;
  weights.integral = object.number("integral");
  weights.position = object.number("position");
  weights.velocity = object.number("velocity");
  weights.torque = object.number("torque");
  object.finish();
  return weights;
}

FeedbackGains gains_from_json(StrictObject object) {
  FeedbackGains gains;
  gains.controller = text_field<8>(object, "controller");
  gains.has_integrator = object.boolean("has_integrator") ? 1 : 0;
  gains.weights = weights_from_json(object.object("weights"));
  gains.decay_rate = object.number("decay_rate");
  gains.cost_bound = object.number("cost_bound");
  std::vector<StrictObject> rules = object.objects("rules", 1, kMaxRules);
  gains.rule_count = static_cast<std::int32_t>(rules.size());
  for (std::size_t j = 0; j < rules.size(); ++j) {
    std::ranges::copy(rules[j].numbers("F", kMaxStates), gains.F[j].begin());
    std::ranges::copy(rules[j].matrix("P", kMaxStates, kMaxStates), gains.P[j].begin());
    rules[j].finish();
  }
  object.finish();
  return gains;
}

Provenance provenance_from_json(StrictObject object) {
  Provenance provenance;
  const bool euler = is_first(object, "sampling", kSamplings);
  provenance.sampling = euler ? Sampling::kForwardEuler : Sampling::kZeroOrderHold;
  provenance.created_utc = text_field<32>(object, "created_utc");
  provenance.tool = text_field<32>(object, "tool");
  provenance.friction_sha256 = text_field<72>(object, "friction_sha256");
  provenance.note = text_field<64>(object, "note");
  object.finish();
  return provenance;
}

}  // namespace

std::string to_json(const GainTable& table) {
  const ordered_json document = {{"format", table.format},
                                 {"name", table.name.view()},
                                 {"plant", plant_to_json(table.plant)},
                                 {"box", box_to_json(table.box)},
                                 {"friction", fuzzy_friction_to_json(table.friction)},
                                 {"torque_limit_Nm", table.torque_limit_Nm},
                                 {"primary", gains_to_json(table.primary)},
                                 {"provenance", provenance_to_json(table.provenance)}};
  return document.dump(2) + "\n";
}

GainTable gain_table_from_json(std::string_view text, const std::string& source) {
  const ordered_json document = parse_strict_json(text, source);
  StrictObject object(document, source);
  GainTable table;
  if (object.has("exponential"))
    throw InputError(source +
                     ": holds fitted friction, not gains: strainwave-design gains makes a table of it");
  // The format first: another one has other keys.
  const long long format = object.integer("format");
  if (format != kGainTableFormat) {
    throw InputError(
        source, "format", std::to_string(format),
        "this program reads format " + std::to_string(kGainTableFormat) + "; design the table again");
  }
  table.name = text_field<48>(object, "name");
  table.plant = plant_from_json(object.object("plant"));
  table.box = box_from_json(object.object("box"));
  table.friction = fuzzy_friction_from_json(object.object("friction"));
  table.torque_limit_Nm = object.number("torque_limit_Nm");
  table.primary = gains_from_json(object.object("primary"));
  table.provenance = provenance_from_json(object.object("provenance"));
  object.finish();
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
