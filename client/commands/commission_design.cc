// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/commission_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/toml_section.h"
#include "control/joint/gear_catalogue.h"
#include "control/table/certified_box.h"

namespace strainwave {

namespace {

constexpr double kLinkShare = 0.1;
constexpr double kStiffnessShare = 0.02;
constexpr double kDampingShare = 1.0 / 3.0;
constexpr double kNextPeriod = 0.25;
static_assert(kMostDelay_periods == kMaxBoxDelay + kNextPeriod);
constexpr double kFirstMotion_rad = 0.1;
// Significant digits of a number in the configuration and in the table.
constexpr int kDigits = 5;

constexpr std::string_view kDelay = "delay_periods";
constexpr std::string_view kGravity = "control.gravity_";

const CommissionValue& value_of(const CommissionRecord& record, std::string_view key) {
  if (const CommissionValue* value = find_value(record.values, key)) return *value;
  throw InputError("commission", "values", std::string(key), "must be measured; commission the joint again");
}

bool is_delay(const CommissionValue& value) {
  return value.key.ends_with(kDelay);
}

/// The delay in whole periods, as a range.
std::string delay_range(const CommissionValue& delay) {
  return fmt::format("{}..{}", delay.used,
                     std::max(delay.used, std::ceil(delay.measured.value - kNextPeriod)));
}

std::string range(const CommissionValue& value, double share) {
  const double half = std::max(share * value.used, value.measured.half_width_95);
  return fmt::format("{:.5g}..{:.5g}", std::max(0.0, value.used - half), value.used + half);
}

}  // namespace

JointToDesign read_joint_to_design(const std::filesystem::path& config, const std::string& name) {
  TomlSection file = TomlSection::read(config);
  JointToDesign found;
  TomlSection daemon = file.section_or_empty("daemon");
  found.period_s = daemon.number_or("period_s", 1e-3, kPositive);
  found.prefix = daemon.text_or("prefix", found.prefix);
  for (TomlSection& joint : file.sections("joint")) {
    if (joint.text("name") != name) continue;
    if (joint.text_or("model", "") != "flexible" || !joint.has("gear"))
      joint.fail(
          "gear",
          "a joint with model = \"flexible\" and a gear of the catalogue is allowed: the design takes "
          "friction over temperature from the gear, and scales the gear's stiffness to the measured one");
    found.gear = joint.text("gear");
    if (find_gear(found.gear) == nullptr) joint.fail("gear", "one of " + gear_names() + " is allowed");
    found.joint_model = joint.text("joint_model");
    found.homed = joint.section_or_empty("homing").text_or("to", "none") != "none";
    TomlSection limits = joint.section("limits");
    const double low_rad = limits.number("position_min_rad", {-1e4, 1e4});
    const double high_rad = limits.number("position_max_rad", {-1e4, 1e4});
    found.first_target_rad =
        0.5 * (low_rad + high_rad) + std::min(kFirstMotion_rad, 0.25 * (high_rad - low_rad));
    return found;
  }
  throw InputError(config.string(), "joint.name", name, "the name of one of its joints is allowed");
}

std::vector<std::string> gains_arguments(const CommissionRecord& record, const JointToDesign& joint,
                                         const std::filesystem::path& friction,
                                         const std::filesystem::path& table) {
  const auto delay = std::ranges::find_if(record.values, is_delay);
  std::vector<std::string> arguments{
      "gains",
      "--gear",
      joint.gear,
      "--joint-model",
      joint.joint_model,
      "--friction",
      friction.string(),
      "--period_s",
      fmt::format("{}", joint.period_s),
      "--motor-inertia_kgm2",
      fmt::format("{}", rounded(value_of(record, "motor_inertia_kgm2").used, kDigits)),
      "--load-inertia_kgm2",
      range(value_of(record, "load_inertia_kgm2"), kLinkShare),
      "--stiffness_Nm_rad",
      range(value_of(record, "stiffness_Nm_rad"), kStiffnessShare),
      "--delay",
      delay_range(delay != record.values.end() ? *delay : value_of(record, kDelay))};
  if (const CommissionValue* damping = find_value(record.values, "damping_Nms_rad"))
    arguments.insert(arguments.end(), {"--damping_Nms_rad", range(*damping, kDampingShare)});
  arguments.insert(arguments.end(), {"--out", table.string()});
  return arguments;
}

std::vector<JointSetting> measured_settings(const CommissionRecord& record, const JointToDesign& joint,
                                            const std::string& table) {
  const CommissionValue* const gravity = find_value(record.values, "control.gravity_Nm");
  const bool has_gravity =
      !joint.homed && gravity != nullptr && gravity->measured.value > gravity->measured.half_width_95;
  std::vector<JointSetting> settings{{"table", table}};
  for (const CommissionValue& value : record.values) {
    constexpr std::array kOwn{"motor_inertia_kgm2", "load_inertia_kgm2", "stiffness_Nm_rad",
                              "damping_Nms_rad"};
    if (is_delay(value) && value.key.size() > kDelay.size())
      settings.push_back({value.key, value.used});
    else if (std::ranges::find(kOwn, value.key) != kOwn.end() ||
             (has_gravity && value.key.starts_with(kGravity)))
      settings.push_back({value.key, rounded(value.used, kDigits)});
  }
  return settings;
}

}  // namespace strainwave
