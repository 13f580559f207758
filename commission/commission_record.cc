// SPDX-License-Identifier: BSD-3-Clause
#include "commission/commission_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/json_fields.h"
#include "base/text_file.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxConfigurationBytes = 1U << 20U;
constexpr int kFormat = 1;
constexpr const char* kFile = "commission.json";

}  // namespace

template <typename Json>
void fields(Json& json, IntervalEstimate& estimate) {
  json("value", estimate.value);
  json("half_width_95", estimate.half_width_95);
  json.require(estimate.half_width_95 >= 0.0, "half_width_95", "0 or more");
}

template <typename Json>
void fields(Json& json, CommissionStep& step) {
  json("name", step.name);
  json.name("outcome", step.outcome, std::array{"done", "failed", "skipped"});
  json("text", step.text);
  json("time_s", step.time_s);
}

template <typename Json>
void fields(Json& json, CommissionValue& value) {
  json("key", value.key);
  json("unit", value.unit);
  json("configured", value.configured);
  json("measured", value.measured.value);
  json("half_width_95", value.measured.half_width_95);
  json("used", value.used);
}

template <typename Json>
void fields(Json& json, FrictionAtSpeed& point) {
  json("speed_rad_s", point.speed_rad_s);
  std::optional<double> temperature_C;
  if (std::isfinite(point.temperature_C)) temperature_C = point.temperature_C;
  json("temperature_C", temperature_C);
  json.require(!temperature_C || (*temperature_C > -273.15 && *temperature_C < 1000.0), "temperature_C",
               "from -273.15 to 1000");
  point.temperature_C = temperature_C.value_or(std::numeric_limits<double>::quiet_NaN());
  json("torque_Nm", point.torque_Nm.value);
  json("half_width_95_Nm", point.torque_Nm.half_width_95);
  json.require(point.torque_Nm.half_width_95 >= 0.0, "half_width_95_Nm", "0 or more");
}

template <typename Json>
void fields(Json& json, ResponsePoint& point) {
  json("frequency_Hz", point.frequency_Hz);
  json("magnitude_rad_sNm", point.magnitude_rad_sNm);
  json("phase_rad", point.phase_rad);
}

template <typename Json>
void fields(Json& json, ResponseModel& model) {
  json("motor_inertia_kgm2", model.motor_inertia_kgm2);
  json("link_inertia_kgm2", model.link_inertia_kgm2);
  json("stiffness_Nm_rad", model.stiffness_Nm_rad);
  json("damping_Nms_rad", model.damping_Nms_rad);
  json("delay_s", model.delay_s);
}

template <typename Json>
void fields(Json& json, CommissionRecord& record) {
  json.format(kFormat, "commission the joint again");
  json("joint", record.joint);
  json("configuration", record.configuration);
  json.text("configuration_text", record.configuration_text, kMaxConfigurationBytes);
  json("simulated", record.simulated);
  json("joint_time_s", record.joint_time_s);
  json("temperature_C", record.temperature_C);
  json("steps", record.steps);
  json("values", record.values);
  json("friction", record.friction);
  json("response", record.response);
  json("model", record.model);
  json("breakaway_positive_Nm", record.breakaway_positive_Nm);
  json("breakaway_negative_Nm", record.breakaway_negative_Nm);
  json("kinematic_error_rad", record.kinematic_error_rad);
  json("problem", record.problem);
}

std::string to_json(const CommissionRecord& record) {
  return json_text(record);
}

const CommissionValue* find_value(const std::vector<CommissionValue>& values, std::string_view key) {
  const auto found = std::ranges::find(values, key, &CommissionValue::key);
  return found == values.end() ? nullptr : &*found;
}

CommissionRecord parse_commission_record(std::string_view text, const std::string& source) {
  return from_json_text<CommissionRecord>(text, source);
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
