// SPDX-License-Identifier: BSD-3-Clause
// Compares the configuration of a joint with its measurement. Joint side, SI. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commission/commission_record.h"
#include "commission/estimates.h"
#include "control/joint/gravity_load.h"

namespace strainwave {

/// Numbers of the configuration; nothing: the configuration does not have it.
struct ConfiguredNumbers {
  std::optional<double> motor_inertia_kgm2;
  std::optional<double> load_inertia_kgm2;
  std::optional<double> stiffness_1_Nm_rad;
  std::optional<double> damping_Nms_rad;
  std::optional<GravityLoad> gravity;
  int delay_periods = 0;
  std::string delay_key;  ///< "can.delay_periods"
  double gear_ratio = 0.0;
  double period_s = 0.0;
};

/// Configured and measured value of each number that `motion` shows, in the configuration's order.
std::vector<CommissionValue> compare_with(const ConfiguredNumbers& configured, const MotionEstimates& motion);

/// Whether the two differ by more than 30 % beyond the interval of the measurement. Delay and gravity zero have absolute tolerances.
bool differs(const CommissionValue& value);

/// Names the wrong numbers of the configuration with the measured values; empty if there are none. If inertias and spring are wrong by
/// the same factor, the text names a wrong scale of torque or position instead.
std::string find_wrong(const std::vector<CommissionValue>& values, double gear_ratio);

/// Explains that the measured delay is longer than a table allows; empty if it is not.
std::string find_late(const std::vector<CommissionValue>& values);

}  // namespace strainwave
