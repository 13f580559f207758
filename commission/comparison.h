// SPDX-License-Identifier: BSD-3-Clause
// What the configuration says of a joint against what was measured of it. Joint side, SI. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commission/commission_record.h"
#include "commission/estimates.h"
#include "control/joint/gravity_load.h"

namespace strainwave {

/// Nothing: it is not in the configuration.
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

/// All that `motion` has, in the configuration's order.
std::vector<CommissionValue> compare_with(const ConfiguredNumbers& configured, const MotionEstimates& motion);

/// Whether the two differ by 30 %, beyond the interval of the measurement.
bool differs(const CommissionValue& value);

/// Names the numbers of the configuration that are wrong, and what is measured; empty where none is. Where inertias and spring are off by
/// one factor, it is torque or position that has the wrong scale.
std::string find_wrong(const std::vector<CommissionValue>& values, double gear_ratio);

/// Says so where the measured delay is longer than a table can have; empty where it is not.
std::string find_late(const std::vector<CommissionValue>& values);

}  // namespace strainwave
