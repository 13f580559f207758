// SPDX-License-Identifier: BSD-3-Clause
// Evidence for a diagnosis: states of one joint over time, the daemon's other messages, and the configuration. Joint side, SI.
// Not real-time.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <vector>

#include "doctor/configured_joint.h"

namespace strainwave {

/// One cycle of the joint, from state_v1 or a flight record.
struct DoctorSample {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::int64_t cycle = 0;
  std::int64_t utime = 0;  ///< sender's clock, us; 0: not known
  double setpoint_velocity_rad_s = 0.0;
  double joint_position_rad = 0.0;
  double torque_commanded_Nm = 0.0;
  double torque_applied_Nm = 0.0;
  double temperature_used_C = kUnknown;
  double link_position_rad = kUnknown;  ///< NaN: there is no second encoder
  double friction_factor = kUnknown;
  std::int32_t mode = 0;
  std::int32_t fault = 0;
  std::int32_t notices = 0;
  std::int32_t temperature_status = 0;
  std::int64_t drive_error = 0;
};

struct Evidence {
  ConfiguredJoint told;
  double period_s = 0.001;  ///< of the loop; limits and timing messages correct it
  std::vector<DoctorSample> samples;
  std::vector<temperature_v1> temperatures;
  std::vector<timing_v1> timings;
  std::optional<limits_v1> limits;

  void take(const state_v1& state);
  void take(const temperature_v1& temperature) { temperatures.push_back(temperature); }
  void take(const timing_v1& timing);
  /// Keeps the limits and the period, and completes an inertia that the configuration file lacks.
  void take(const limits_v1& published);
  /// Ignores messages without information about the joint.
  template <typename Message>
  void take(const Message&) {}

  /// Size of an encoder count, with a typical value if the configuration has none.
  double count_rad() const { return told.count_rad.value_or(5e-5); }
  /// The joint's torque limit, with a typical value if no limits were received.
  double torque_limit_Nm() const { return limits ? limits->torque_limit_Nm : 30.0; }
  /// 0: not known.
  double gear_ratio() const { return limits ? limits->gear_ratio : 0.0; }
  /// Whether torque oscillated until fault 26 ended the motion.
  bool chattered() const;
  /// Mean of the temperatures that the controller used; NaN: none.
  double mean_temperature_C() const;
  /// Friction of the configured gain table at this temperature. Nothing: no table, or no temperature.
  std::optional<FrictionParameters> friction_at(double temperature_C) const;
  /// Median distance of consecutive samples, periods; 0: fewer than two samples.
  std::int64_t stride_periods() const;
};

}  // namespace strainwave
