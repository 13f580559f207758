// SPDX-License-Identifier: BSD-3-Clause
#include "commission/commission_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/input_error.h"
#include "base/strict_json.h"
#include "base/text_file.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxConfigurationBytes = 1U << 20U;

using nlohmann::ordered_json;

constexpr long long kFormat = 1;
// More than any run makes.
constexpr std::size_t kMostEntries = 10'000;
constexpr std::array<std::string_view, 3> kOutcomes{"done", "failed", "skipped"};
constexpr const char* kFile = "commission.json";

ordered_json interval(const IntervalEstimate& estimate) {
  return {{"value", estimate.value}, {"half_width_95", estimate.half_width_95}};
}

IntervalEstimate read_interval(StrictObject object) {
  const IntervalEstimate estimate{object.number("value"), object.number("half_width_95")};
  object.finish();
  return estimate;
}

std::optional<double> number_if_there(StrictObject& object, const std::string& key) {
  return object.has(key) ? std::optional(object.number(key)) : std::nullopt;
}

std::optional<IntervalEstimate> interval_if_there(StrictObject& object, const std::string& key) {
  return object.has(key) ? std::optional(read_interval(object.object(key))) : std::nullopt;
}

ordered_json json_of(const CommissionStep& step) {
  return {{"name", step.name},
          {"outcome", kOutcomes[static_cast<std::size_t>(step.outcome)]},
          {"text", step.text},
          {"time_s", step.time_s}};
}

CommissionStep read_step(StrictObject& object) {
  CommissionStep step;
  step.name = object.text("name", kMaxTextBytes);
  const std::string outcome = object.text("outcome", kMaxTextBytes);
  const auto* const found = std::find(kOutcomes.begin(), kOutcomes.end(), outcome);
  if (found == kOutcomes.end())
    throw InputError(object.where("outcome") + " = \"" + outcome +
                     "\": \"done\", \"failed\" or \"skipped\" is allowed");
  step.outcome = static_cast<StepOutcome>(found - kOutcomes.begin());
  step.text = object.text("text", kMaxTextBytes);
  step.time_s = object.number("time_s");
  object.finish();
  return step;
}

ordered_json json_of(const CommissionValue& value) {
  ordered_json json{{"key", value.key}, {"unit", value.unit}};
  if (value.configured) json["configured"] = *value.configured;
  json["measured"] = value.measured.value;
  json["half_width_95"] = value.measured.half_width_95;
  json["used"] = value.used;
  return json;
}

CommissionValue read_value(StrictObject& object) {
  CommissionValue value;
  value.key = object.text("key", kMaxTextBytes);
  value.unit = object.text("unit", kMaxTextBytes);
  value.configured = number_if_there(object, "configured");
  value.measured = {object.number("measured"), object.number("half_width_95")};
  value.used = object.number("used");
  object.finish();
  return value;
}

ordered_json json_of(const FrictionAtSpeed& point) {
  ordered_json json{{"speed_rad_s", point.speed_rad_s}};
  if (std::isfinite(point.temperature_C)) json["temperature_C"] = point.temperature_C;
  json["torque_Nm"] = point.torque_Nm.value;
  json["half_width_95_Nm"] = point.torque_Nm.half_width_95;
  return json;
}

FrictionAtSpeed read_friction_point(StrictObject& object) {
  FrictionAtSpeed point;
  point.speed_rad_s = object.number("speed_rad_s");
  point.temperature_C =
      number_if_there(object, "temperature_C").value_or(std::numeric_limits<double>::quiet_NaN());
  point.torque_Nm = {object.number("torque_Nm"), object.number("half_width_95_Nm")};
  object.finish();
  return point;
}

ordered_json json_of(const ResponsePoint& point) {
  return {{"frequency_Hz", point.frequency_Hz},
          {"magnitude_rad_sNm", point.magnitude_rad_sNm},
          {"phase_rad", point.phase_rad}};
}

ResponsePoint read_response_point(StrictObject& object) {
  const ResponsePoint point{object.number("frequency_Hz"), object.number("magnitude_rad_sNm"),
                            object.number("phase_rad")};
  object.finish();
  return point;
}

ordered_json json_of(const ResponseModel& model) {
  return {{"motor_inertia_kgm2", model.motor_inertia_kgm2},
          {"link_inertia_kgm2", model.link_inertia_kgm2},
          {"stiffness_Nm_rad", model.stiffness_Nm_rad},
          {"damping_Nms_rad", model.damping_Nms_rad},
          {"delay_s", model.delay_s}};
}

ResponseModel read_model(StrictObject object) {
  const ResponseModel model{object.number("motor_inertia_kgm2"), object.number("link_inertia_kgm2"),
                            object.number("stiffness_Nm_rad"), object.number("damping_Nms_rad"),
                            object.number("delay_s")};
  object.finish();
  return model;
}

template <typename Entry>
ordered_json json_of(const std::vector<Entry>& entries) {
  ordered_json list = ordered_json::array();
  for (const Entry& entry : entries) list.push_back(json_of(entry));
  return list;
}

template <typename Entry>
std::vector<Entry> read_list(StrictObject& object, const std::string& key, Entry (*read)(StrictObject&)) {
  std::vector<Entry> entries;
  for (StrictObject& entry : object.objects(key, 0, kMostEntries)) entries.push_back(read(entry));
  return entries;
}

}  // namespace

std::string to_json(const CommissionRecord& record) {
  ordered_json json{{"format", kFormat},
                    {"joint", record.joint},
                    {"configuration", record.configuration},
                    {"configuration_text", record.configuration_text},
                    {"simulated", record.simulated},
                    {"joint_time_s", record.joint_time_s}};
  if (record.temperature_C) json["temperature_C"] = *record.temperature_C;
  json["steps"] = json_of(record.steps);
  json["values"] = json_of(record.values);
  json["friction"] = json_of(record.friction);
  json["response"] = json_of(record.response);
  if (record.model) json["model"] = json_of(*record.model);
  if (record.breakaway_positive_Nm) json["breakaway_positive_Nm"] = interval(*record.breakaway_positive_Nm);
  if (record.breakaway_negative_Nm) json["breakaway_negative_Nm"] = interval(*record.breakaway_negative_Nm);
  if (record.kinematic_error_rad) json["kinematic_error_rad"] = *record.kinematic_error_rad;
  json["problem"] = record.problem;
  return json.dump(2) + "\n";
}

const CommissionValue* find_value(const std::vector<CommissionValue>& values, std::string_view key) {
  const auto found = std::ranges::find(values, key, &CommissionValue::key);
  return found == values.end() ? nullptr : &*found;
}

CommissionRecord parse_commission_record(std::string_view text, const std::string& source) {
  const ordered_json json = parse_strict_json(text, source);
  StrictObject object(json, source);
  if (const long long format = object.integer("format"); format != kFormat)
    throw InputError(object.where("format") + " = " + std::to_string(format) + ": " +
                     std::to_string(kFormat) + " is allowed: commission the joint again");
  CommissionRecord record;
  record.joint = object.text("joint", kMaxTextBytes);
  record.configuration = object.text("configuration", kMaxTextBytes);
  record.configuration_text = object.text("configuration_text", kMaxConfigurationBytes);
  record.simulated = object.boolean("simulated");
  record.joint_time_s = object.number("joint_time_s");
  record.temperature_C = number_if_there(object, "temperature_C");
  record.steps = read_list(object, "steps", &read_step);
  record.values = read_list(object, "values", &read_value);
  record.friction = read_list(object, "friction", &read_friction_point);
  record.response = read_list(object, "response", &read_response_point);
  if (object.has("model")) record.model = read_model(object.object("model"));
  record.breakaway_positive_Nm = interval_if_there(object, "breakaway_positive_Nm");
  record.breakaway_negative_Nm = interval_if_there(object, "breakaway_negative_Nm");
  if (object.has("kinematic_error_rad")) {
    const std::vector<double> errors = object.numbers("kinematic_error_rad", 2);
    record.kinematic_error_rad = {errors[0], errors[1]};
  }
  record.problem = object.text("problem", kMaxTextBytes);
  object.finish();
  return record;
}

void write_commission_record(const std::filesystem::path& directory, const CommissionRecord& record) {
  make_folder(directory);
  write_text_file(directory / kFile, to_json(record));
}

std::optional<CommissionRecord> read_commission_record(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / kFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  return parse_commission_record(read_text_file(file), file.string());
}

}  // namespace strainwave
