// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/printable.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

static_assert(std::is_trivially_copyable_v<GainTable>, "tables are exchanged as bytes");

namespace {

// Of every number, in SI: what is beyond is no joint's, and no arithmetic with what is within overflows.
constexpr double kLeast = 1e-9;
constexpr double kMost = 1e15;
// Of the torque limit: a joint that needs more to break away has less left for motion than friction takes; the coldest rule of the
// catalogue's joint needs 0.17.
constexpr double kMaxStaticShare = 0.5;
constexpr double kAbsoluteZero_C = -273.15;

// Collects the first defect only: every check after it is skipped.
class TableInspector {
 public:
  // low <= value <= high, not NaN.
  void in_range(const std::string& key, double value, double low, double high) {
    if (found_ || (value >= low && value <= high)) return;
    found_ =
        key + " = " + number_text(value) + ": must be from " + number_text(low) + " to " + number_text(high);
  }
  // 0 < value <= high.
  void positive(const std::string& key, double value, double high) {
    if (found_ || (value > 0.0 && value <= high)) return;
    found_ = key + " = " + number_text(value) + ": must be above 0 and at most " + number_text(high);
  }
  void require(bool condition, const std::string& message) {
    if (!found_ && !condition) found_ = message;
  }
  // Printable ASCII, terminated, zeros after it: the bytes are compared and printed as they are.
  template <std::size_t N>
  void text(const std::string& key, const FixedString<N>& value, bool may_be_empty) {
    if (found_) return;
    const std::string_view view = value.view();
    bool good = view.size() < N && (may_be_empty || !view.empty());
    for (const char c : view) good = good && c >= ' ' && c <= '~';
    for (std::size_t i = view.size(); i < N; ++i) good = good && value.bytes[i] == '\0';
    require(good, key + ": must be " + (may_be_empty ? "0" : "1") + " to " + std::to_string(N - 1) +
                      " printable ASCII characters, zero padded");
  }
  bool ok() const { return !found_; }
  std::optional<std::string> defect() const { return found_; }

 private:
  std::optional<std::string> found_;
};

void inspect_plant(TableInspector& inspector, const PlantIdentity& plant) {
  inspector.text("plant.joint_model", plant.joint_model, false);
  inspector.positive("plant.inertia_kgm2", plant.inertia_kgm2, kMost);
  inspector.positive("plant.gear_ratio", plant.gear_ratio, kMost);
  inspector.in_range("plant.period_s", plant.period_s, kLeast, kMost);
  inspector.text("plant.gear", plant.gear, true);
  if (!inspector.ok() || plant.gear.view().empty()) return;
  const Gear* gear = find_gear(plant.gear.view());
  const std::string said = "plant.gear = " + std::string(plant.gear.view());
  inspector.require(gear != nullptr, said + ": must be empty or one of " + gear_names());
  inspector.require(gear == nullptr || is_same_number(plant.gear_ratio, gear->ratio),
                    said + ": must be a gear of plant.gear_ratio = " + number_text(plant.gear_ratio));
}

void inspect_range(TableInspector& inspector, const std::string& key, const BoxRange& range, double least,
                   double most) {
  inspector.in_range(key + "[0]", range.from, least, most);
  inspector.in_range(key + "[1]", range.to, range.from, most);
}

bool is_zero(const BoxRange& range) {
  return range.from == 0.0 && range.to == 0.0;
}

void inspect_cell(TableInspector& inspector, const CertifiedBox& box, const BoxCell& cell,
                  const std::string& key) {
  inspector.in_range(key + "delay_periods", cell.delay_periods, box.least_delay, box.most_delay);
  if (box.rigid()) {
    inspector.require(is_zero(cell.stiffness_Nm_rad) && is_zero(cell.link_inertia_kgm2),
                      key + ": of a rigid joint, must say nothing of a spring");
  } else {
    inspect_range(inspector, key + "stiffness_Nm_rad", cell.stiffness_Nm_rad, kLeast, kMost);
    inspect_range(inspector, key + "link_inertia_kgm2", cell.link_inertia_kgm2, kLeast, kMost);
  }
  if (!inspector.ok()) return;
  for (std::size_t i = 0; i < kCellEntries; ++i) {
    const std::string entry = key + "P[" + std::to_string(i) + "]";
    inspector.in_range(entry, cell.P[i], -kMost, kMost);
    inspector.require(i < box.entries_of(cell) || cell.P[i] == 0.0, entry + ": must be 0 beyond the matrix");
  }
}

void inspect_cells(TableInspector& inspector, const CertifiedBox& box) {
  for (std::size_t i = 0; inspector.ok() && i < box.cells.size(); ++i) {
    const BoxCell& cell = box.cells[i];
    const std::string key = "box.cells[" + std::to_string(i) + "].";
    if (i < static_cast<std::size_t>(box.cell_count)) {
      inspect_cell(inspector, box, cell, key);
      continue;
    }
    const bool zero = cell.delay_periods == 0 && is_zero(cell.stiffness_Nm_rad) &&
                      is_zero(cell.link_inertia_kgm2) && cell.P == decltype(cell.P){};
    inspector.require(zero, key + ": must be 0 beyond cell_count");
  }
}

void inspect_box(TableInspector& inspector, const GainTable& table) {
  const CertifiedBox& box = table.box;
  const auto side = static_cast<std::int32_t>(box.encoder_side);
  inspector.require(side == 0 || side == 1,
                    "box.encoder_side = " + std::to_string(side) + ": must be 0 (motor) or 1 (link)");
  inspector.in_range("box.cell_count", box.cell_count, 0, kMaxBoxCells);
  inspector.in_range("box.delay_periods[0]", box.least_delay, 0, kMaxBoxDelay);
  inspector.in_range("box.delay_periods[1]", box.most_delay, box.least_delay, kMaxBoxDelay);
  inspector.in_range("box.lead_periods", box.lead_periods, 0.0, kMaxLeadPeriods);
  if (!inspector.ok()) return;
  if (box.rigid()) {
    inspector.require(is_zero(box.motor_inertia_kgm2) && is_zero(box.link_inertia_kgm2) &&
                          is_zero(box.stiffness_Nm_rad) && is_zero(box.damping_Nms_rad) &&
                          box.lead_periods == 0.0,
                      "box: a rigid one must say nothing of a spring");
  } else {
    inspector.require(box.cell_count > 0, "box.cell_count = 0: must be at least 1 unless the joint is rigid");
    inspector.require(!table.plant.gear.view().empty(),
                      "plant.gear: must be named where the joint has a spring");
    inspect_range(inspector, "box.motor_inertia_kgm2", box.motor_inertia_kgm2, kLeast, kMost);
    inspect_range(inspector, "box.link_inertia_kgm2", box.link_inertia_kgm2, kLeast, kMost);
    inspect_range(inspector, "box.stiffness_Nm_rad", box.stiffness_Nm_rad, kLeast, kMost);
    inspect_range(inspector, "box.damping_Nms_rad", box.damping_Nms_rad, 0.0, kMost);
  }
  inspect_cells(inspector, box);
}

// Friction is fed forward beside the certified feedback: it must be friction, and less than the motor can give.
void inspect_rule_friction(TableInspector& inspector, const FrictionParameters& friction,
                           double torque_limit_Nm, const std::string& key) {
  const double most_Nm = kMaxStaticShare * torque_limit_Nm;
  inspector.require(friction.static_Nm >= 0.0 && friction.static_Nm <= most_Nm,
                    key + "static_Nm = " + number_text(friction.static_Nm) + ": must be from 0 to " +
                        number_text(most_Nm) +
                        ", half of torque_limit_Nm, or friction takes more than it leaves");
  inspector.in_range(key + "coulomb_Nm", friction.coulomb_Nm, 0.0, friction.static_Nm);
  inspector.in_range(key + "viscous_Nms_rad", friction.viscous_Nms_rad, 0.0, kMost);
}

void inspect_velocity_memberships(TableInspector& inspector, const VelocityMemberships& velocity) {
  const std::string key = "friction.velocity.";
  inspector.in_range(key + "zero_center_rad_s", velocity.zero_center_rad_s, 0.0, kMost);
  inspector.in_range(key + "zero_width_rad_s", velocity.zero_width_rad_s, kLeast, kMost);
  inspector.in_range(key + "high_center_rad_s", velocity.high_center_rad_s, 0.0, kMost);
  inspector.in_range(key + "high_width_rad_s", velocity.high_width_rad_s, kLeast, kMost);
}

void inspect_friction(TableInspector& inspector, const FuzzyFriction& friction, double torque_limit_Nm) {
  inspector.in_range("friction.rule_count", friction.rule_count, 1, kMaxTemperatureRules);
  inspector.in_range("friction.temperature_min_C", friction.temperature_min_C, kAbsoluteZero_C, kMost);
  inspector.in_range("friction.temperature_max_C", friction.temperature_max_C, kAbsoluteZero_C, kMost);
  inspector.require(friction.temperature_min_C < friction.temperature_max_C,
                    "friction.temperature_max_C: must be above friction.temperature_min_C");
  inspect_velocity_memberships(inspector, friction.velocity);
  for (int i = 0; inspector.ok() && i < friction.rule_count; ++i) {
    const TemperatureRule& rule = friction.rules[static_cast<std::size_t>(i)];
    const std::string key = "friction.rules[" + std::to_string(i) + "].";
    inspector.in_range(key + "center_C", rule.center_C, kAbsoluteZero_C, kMost);
    inspector.in_range(key + "width_C", rule.width_C, kLeast, kMost);
    inspect_rule_friction(inspector, rule.friction, torque_limit_Nm, key);
    const bool ascending = i == 0 || friction.rules[static_cast<std::size_t>(i - 1)].center_C < rule.center_C;
    inspector.require(ascending, key + "center_C = " + number_text(rule.center_C) + ": centres must ascend");
  }
}

void inspect_rule(TableInspector& inspector, const FeedbackGains& gains, int rule, const std::string& key) {
  const GainRow F = gains.gain(rule);
  const StateMatrix P = gains.lyapunov(rule);
  const auto name = [&](const char* matrix, Eigen::Index row) {
    return key + ".rules[" + std::to_string(rule) + "]." + matrix + "[" + std::to_string(row) + "]";
  };
  for (Eigen::Index a = 0; inspector.ok() && a < kMaxStates; ++a) {
    const bool unused = a == 0 && !gains.has_integrator;
    inspector.in_range(name("F", a), F(a), -kMost, kMost);
    inspector.require(!unused || F(a) == 0.0, name("F", a) + ": must be 0 without an integrator");
    for (Eigen::Index b = 0; b < kMaxStates; ++b) {
      std::string entry = name("P", a);
      entry += "[" + std::to_string(b) + "]";
      inspector.in_range(entry, P(a, b), -kMost, kMost);
      inspector.require(P(a, b) == P(b, a), entry + " = " + number_text(P(a, b)) + ": P must be symmetric");
      inspector.require(!unused || P(a, b) == 0.0, entry + ": must be 0 without an integrator");
    }
  }
}

void inspect_gains(TableInspector& inspector, const FeedbackGains& gains, int plant_rules,
                   const std::string& key) {
  inspector.require(gains.has_integrator == 0 || gains.has_integrator == 1,
                    key + ".has_integrator: must be 0 or 1");
  inspector.require(gains.rule_count == 1 || gains.rule_count == plant_rules,
                    key + ".rule_count = " + std::to_string(gains.rule_count) +
                        ": must be 1 (temperature-free) or 1 + the number of temperature rules");
  if (!inspector.ok()) return;
  const char* const expected =
      gains.has_integrator ? (gains.scheduled() ? "C4" : "C3") : (gains.scheduled() ? "C2" : "C1");
  inspector.require(gains.controller == FixedString<8>(expected),
                    key + ".controller: must be " + expected + " for these states and this number of rules");
  inspector.in_range(key + ".weights.integral", gains.weights.integral, 0.0, kMost);
  inspector.require((gains.weights.integral > 0.0) == (gains.has_integrator == 1),
                    key + ".weights.integral: must be above 0 with an integrator and 0 without");
  inspector.positive(key + ".weights.position", gains.weights.position, kMost);
  inspector.in_range(key + ".weights.velocity", gains.weights.velocity, 0.0, kMost);
  inspector.positive(key + ".weights.torque", gains.weights.torque, kMost);
  inspector.positive(key + ".decay_rate", gains.decay_rate, 1.0);
  inspector.in_range(key + ".cost_bound", gains.cost_bound, 0.0, kMost);
  for (int j = 0; inspector.ok() && j < gains.rule_count; ++j) inspect_rule(inspector, gains, j, key);
  for (std::size_t j = static_cast<std::size_t>(gains.rule_count); inspector.ok() && j < kMaxRules; ++j) {
    const bool zero =
        gains.F[j] == decltype(gains.F)::value_type{} && gains.P[j] == decltype(gains.P)::value_type{};
    inspector.require(zero, key + ": entries beyond rule_count must be 0");
  }
}

}  // namespace

std::optional<std::string> find_defect(const GainTable& table) {
  TableInspector inspector;
  inspector.require(table.format == kGainTableFormat, "format = " + std::to_string(table.format) +
                                                          ": this program reads format " +
                                                          std::to_string(kGainTableFormat));
  inspector.text("name", table.name, false);
  inspect_plant(inspector, table.plant);
  inspect_box(inspector, table);
  inspector.positive("torque_limit_Nm", table.torque_limit_Nm, kMost);
  inspect_friction(inspector, table.friction, table.torque_limit_Nm);
  const int plant_rules = 1 + table.friction.rule_count;
  inspect_gains(inspector, table.primary, plant_rules, "primary");
  const auto sampling = static_cast<std::int32_t>(table.provenance.sampling);
  inspector.require(sampling == 0 || sampling == 1, "provenance.sampling = " + std::to_string(sampling) +
                                                        ": must be 0 (forward Euler) or 1 (zero-order hold)");
  inspector.text("provenance.created_utc", table.provenance.created_utc, true);
  inspector.text("provenance.tool", table.provenance.tool, true);
  inspector.text("provenance.friction_sha256", table.provenance.friction_sha256, true);
  inspector.text("provenance.note", table.provenance.note, true);
  return inspector.defect();
}

bool is_same_number(double a, double b) noexcept {
  return std::abs(a - b) <= kAtBound * std::abs(b);
}

std::optional<std::string> find_identity_mismatch(const GainTable& table, const PlantIdentity& expected,
                                                  InertiaCheck inertia) {
  const PlantIdentity& plant = table.plant;
  const auto differs = [](const std::string& key, double value, double wanted) {
    return "plant." + key + " = " + number_text(value) + ": this joint has " + number_text(wanted);
  };
  if (!(plant.joint_model == expected.joint_model)) {
    return "plant.joint_model = " + std::string(plant.joint_model.view()) + ": this joint is a " +
           std::string(expected.joint_model.view());
  }
  const bool both_named = !plant.gear.view().empty() && !expected.gear.view().empty();
  if (both_named && !(plant.gear == expected.gear)) {
    return "plant.gear = " + std::string(plant.gear.view()) + ": this joint has a " +
           std::string(expected.gear.view());
  }
  if (inertia == InertiaCheck::kSame && !is_same_number(plant.inertia_kgm2, expected.inertia_kgm2)) {
    return differs("inertia_kgm2", plant.inertia_kgm2, expected.inertia_kgm2);
  }
  if (!is_same_number(plant.gear_ratio, expected.gear_ratio)) {
    return differs("gear_ratio", plant.gear_ratio, expected.gear_ratio);
  }
  if (!is_same_number(plant.period_s, expected.period_s))
    return differs("period_s", plant.period_s, expected.period_s);
  return std::nullopt;
}

}  // namespace strainwave
