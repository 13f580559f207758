// SPDX-License-Identifier: BSD-3-Clause
// The file commission.json with the steps and results of a commissioning. It is written after every step, so that a later run can
// continue. Joint side, SI. Not real-time.
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
  std::string text;     ///< the result, or why there is none
  double time_s = 0.0;  ///< duration of its motion, >= 0
};

/// A table has a delay of at most two whole periods. Its gains tolerate a quarter of a period more (client/commands/commission_design.cc).
inline constexpr double kMostDelay_periods = 2.25;

/// A measured number, with or without a key in the configuration.
struct CommissionValue {
  std::string key;  ///< relative to the joint's section, "motor_inertia_kgm2"; or a name, if there is no key
  std::string unit;
  std::optional<double> configured;  ///< nothing: the configuration does not have it
  IntervalEstimate measured;
  double used = 0.0;
};

/// Response from torque to motor velocity at one frequency.
struct ResponsePoint {
  double frequency_Hz = 0.0;
  double magnitude_rad_sNm = 0.0;
  double phase_rad = 0.0;  ///< negative: the velocity lags
};

/// Model of that response: motor and link on a spring, in series with a delay.
struct ResponseModel {
  double motor_inertia_kgm2 = 0.0;
  double link_inertia_kgm2 = 0.0;
  double stiffness_Nm_rad = 0.0;  ///< at small torque
  double damping_Nms_rad = 0.0;
  double delay_s = 0.0;
};

/// The value with this key; null if there is none.
const CommissionValue* find_value(const std::vector<CommissionValue>& values, std::string_view key);

struct CommissionRecord {
  std::string joint;
  std::string configuration;       ///< path of the file
  std::string configuration_text;  ///< contents of the file
  bool simulated = false;
  double joint_time_s = 0.0;  ///< time with the drive enabled, over all runs
  std::optional<double> temperature_C;
  std::vector<CommissionStep> steps;
  std::vector<CommissionValue> values;
  std::vector<FrictionAtSpeed> friction;  ///< by rising speed
  std::vector<ResponsePoint> response;    ///< by rising frequency
  std::optional<ResponseModel> model;
  std::optional<IntervalEstimate> breakaway_positive_Nm;
  std::optional<IntervalEstimate> breakaway_negative_Nm;     ///< absolute value
  std::optional<std::array<double, 2>> kinematic_error_rad;  ///< amplitudes once and twice per motor turn
  std::string problem;                                       ///< why it ended early; empty if it did not
};

/// Unknown values have no key. All numbers must be finite, except temperatures of friction.
std::string to_json(const CommissionRecord& record);

/// Throws InputError naming `source`, the key and what is allowed.
CommissionRecord parse_commission_record(std::string_view text, const std::string& source);

/// Writes commission.json to `directory`, which is made if it is missing. Reading and writing throw InputError.
void write_commission_record(const std::filesystem::path& directory, const CommissionRecord& record);
/// Nothing if there is no such file.
std::optional<CommissionRecord> read_commission_record(const std::filesystem::path& directory);

}  // namespace strainwave
