// SPDX-License-Identifier: BSD-3-Clause
// Metrics of joints, as a table.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "lcmtypes/cycle_fields.h"
#include "strainwave/vocabulary.h"
#include "telemetry/fleet.h"

namespace strainwave {

namespace {

using Value = std::optional<double>;

struct JointMetric {
  std::string_view name;
  MetricType type;
  std::string_view help;
  Value (*value)(const JointRecord& joint, double now_s);  ///< no value: unknown for this joint
};

Value of_limits(const JointRecord& joint, double limits_v1::*field) {
  return joint.limits ? Value((*joint.limits).*field) : std::nullopt;
}

Value measured_C(const JointRecord& joint, double) {
  if (!joint.temperature || joint.temperature->age_s < 0.0) return std::nullopt;
  return joint.temperature->temperature_measured_C;
}

Value used_C(const JointRecord& joint, double) {
  if (std::isnan(joint.state.temperature_used_C)) return std::nullopt;
  return joint.state.temperature_used_C;
}

using Joint = JointRecord;

constexpr std::array kJointMetrics{
    JointMetric{
        "strainwave_joint_mode", MetricType::kGauge,
        "Mode: 0 off, 1 starting, 2 holding, 3 tracking, 4 stopping, 5 faulted, 6 homing, 7 releasing.",
        [](const Joint& j, double) { return Value(real(j.state.mode)); }},
    JointMetric{"strainwave_joint_faults_total", MetricType::kCounter,
                "Faults latched since the daemon started.",
                [](const Joint& j, double) { return Value(real(j.state.faults_total)); }},
    JointMetric{"strainwave_joint_position_radians", MetricType::kGauge, "Position of the joint.",
                [](const Joint& j, double) { return Value(j.state.joint_position_rad); }},
    JointMetric{"strainwave_joint_setpoint_radians", MetricType::kGauge,
                "Position that the controller tracks.",
                [](const Joint& j, double) { return Value(j.state.setpoint_position_rad); }},
    JointMetric{"strainwave_joint_velocity_radians_per_second", MetricType::kGauge, "Velocity of the joint.",
                [](const Joint& j, double) { return Value(j.state.joint_velocity_rad_s); }},
    JointMetric{"strainwave_joint_tracking_error_peak_radians", MetricType::kGauge,
                "Largest absolute value of setpoint minus position in the last minute.",
                [](const Joint& j, double now_s) { return Value(j.tracking_error_rad.amount(now_s)); }},
    JointMetric{"strainwave_joint_following_error_limit_radians", MetricType::kGauge,
                "Tracking error that causes a fault; 0: none does.",
                [](const Joint& j, double) { return of_limits(j, &limits_v1::following_error_rad); }},
    JointMetric{"strainwave_joint_torque_newton_meters", MetricType::kGauge,
                "Torque commanded, after all limits.",
                [](const Joint& j, double) { return Value(j.state.torque_commanded_Nm); }},
    JointMetric{"strainwave_joint_torque_peak_newton_meters", MetricType::kGauge,
                "Largest absolute value of the torque commanded in the last minute.",
                [](const Joint& j, double now_s) { return Value(j.torque_Nm.amount(now_s)); }},
    JointMetric{"strainwave_joint_torque_limit_newton_meters", MetricType::kGauge, "Torque limit.",
                [](const Joint& j, double) { return of_limits(j, &limits_v1::torque_limit_Nm); }},
    JointMetric{"strainwave_joint_temperature_celsius", MetricType::kGauge, "Temperature last measured.",
                measured_C},
    JointMetric{"strainwave_joint_temperature_used_celsius", MetricType::kGauge,
                "Temperature that the gains are scheduled by.", used_C},
    JointMetric{"strainwave_joint_temperature_valid", MetricType::kGauge,
                "1: the temperature is plausible and fresh; 0: it is not.",
                [](const Joint& j, double) {
                  return Value(real(j.state.temperature_status ==
                                    static_cast<std::int32_t>(TemperatureStatus::kValid)));
                }},
    JointMetric{"strainwave_joint_friction_factor", MetricType::kGauge,
                "Learned friction divided by the table's, at the present temperature.",
                [](const Joint& j, double) { return Value(j.state.friction_factor); }},
    JointMetric{"strainwave_joint_friction_age_seconds", MetricType::kGauge,
                "Time since the joint last learned its friction.",
                [](const Joint& j, double) {
                  return j.state.friction_age_s < 0.0 ? std::nullopt : Value(j.state.friction_age_s);
                }},
};

/// Writes the metrics that exist only while a fault or a notice lasts, under the name of each.
void expose_words(Exposition& page, const Fleet::Joints& joints) {
  page.family("strainwave_joint_fault", MetricType::kGauge, "1 while the fault is latched.");
  for (const auto& [name, joint] : joints)
    if (joint.state.fault != 0)
      page.sample({{"prefix", name.first},
                   {"joint", name.second},
                   {"fault", to_text(static_cast<Fault>(joint.state.fault))}},
                  1.0);
  page.family("strainwave_joint_notice", MetricType::kGauge, "1 while the notice stands.");
  for (const auto& [name, joint] : joints) {
    for (auto left = static_cast<std::uint32_t>(joint.state.notices); left != 0; left &= left - 1) {
      const std::string_view word = to_text(static_cast<Notice>(1U << std::countr_zero(left)));
      // Unknown bits would produce several samples with the same name.
      if (word == "unknown") continue;
      page.sample({{"prefix", name.first}, {"joint", name.second}, {"notice", word}}, 1.0);
    }
  }
}

}  // namespace

void expose_joints(Exposition& page, const Fleet::Joints& joints, double now_s) {
  for (const JointMetric& metric : kJointMetrics) {
    page.family(metric.name, metric.type, metric.help);
    for (const auto& [name, joint] : joints)
      if (const Value value = metric.value(joint, now_s))
        page.sample({{"prefix", name.first}, {"joint", name.second}}, *value);
  }
  expose_words(page, joints);
}

}  // namespace strainwave
