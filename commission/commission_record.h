// SPDX-License-Identifier: BSD-3-Clause
// The file commission.json: what a commissioning did and found. Written after every step, so that a later run can go on where this one
// ended. Joint side, SI. Not real-time.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commission/estimates.h"

namespace strainwave {

enum class StepOutcome { kDone, kFailed, kSkipped };

struct CommissionStep {
  std::string name;
  StepOutcome outcome = StepOutcome::kDone;
  std::string text;     ///< what was found, or why not
  double time_s = 0.0;  ///< of the joint's time that it took, >= 0
};

/// A table has whole delays, two at most, whose gains bear a quarter more (client/commands/commission_design.cc).
inline constexpr double kMostDelay_periods = 2.25;

/// A number of the configuration, or one that has no key there.
struct CommissionValue {
  std::string key;  ///< relative to the joint's section, "motor_inertia_kgm2"; a name where there is no key
  std::string unit;
  std::optional<double> configured;  ///< nothing: it is not in the configuration
  IntervalEstimate measured;
  double used = 0.0;
};

/// Measured torque to motor velocity.
struct ResponsePoint {
  double frequency_Hz = 0.0;
  double magnitude_rad_sNm = 0.0;
  double phase_rad = 0.0;  ///< negative: the velocity lags
};

/// Torque to motor velocity as motor and link on a spring, in series with a delay.
struct ResponseModel {
  double motor_inertia_kgm2 = 0.0;
  double link_inertia_kgm2 = 0.0;
  double stiffness_Nm_rad = 0.0;  ///< of small motion
  double damping_Nms_rad = 0.0;
  double delay_s = 0.0;
};

/// The one with this key; null where there is none.
const CommissionValue* find_value(const std::vector<CommissionValue>& values, std::string_view key);

struct CommissionRecord {
  std::string joint;
  std::string configuration;       ///< path of the file
  std::string configuration_text;  ///< what was in it
  bool simulated = false;
  double joint_time_s = 0.0;  ///< in which the drive was enabled, of all runs
  std::optional<double> temperature_C;
  std::vector<CommissionStep> steps;
  std::vector<CommissionValue> values;
  std::vector<FrictionAtSpeed> friction;  ///< by rising speed
  std::vector<ResponsePoint> response;    ///< by rising frequency
  std::optional<ResponseModel> model;
  std::optional<IntervalEstimate> breakaway_positive_Nm;
  std::optional<IntervalEstimate> breakaway_negative_Nm;     ///< its size
  std::optional<std::array<double, 2>> kinematic_error_rad;  ///< amplitudes once and twice per motor turn
  std::string problem;                                       ///< why it ended early; empty: it did not
};

/// What is not known has no key. Numbers that are not finite may not be in it.
std::string to_json(const CommissionRecord& record);

/// Throws InputError naming `source`, the key and what is allowed.
CommissionRecord parse_commission_record(std::string_view text, const std::string& source);

/// commission.json in `directory`, which is made where it is missing. Throw InputError.
void write_commission_record(const std::filesystem::path& directory, const CommissionRecord& record);
/// Nothing where there is no such file.
std::optional<CommissionRecord> read_commission_record(const std::filesystem::path& directory);

}  // namespace strainwave
