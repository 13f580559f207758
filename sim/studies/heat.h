// SPDX-License-Identifier: BSD-3-Clause
// The cost of a wrong temperature. A joint works for minutes, and its losses warm it. The controller knows
// the temperature exactly, late, biased, only that of the surroundings, or not at all. Offline.
#pragma once

#include <string>
#include <vector>

#include "sim/studies/contenders.h"
#include "sim/studies/figure.h"
#include "sim/studies/text_table.h"

namespace strainwave {

struct HeatConfig {
  JointPlantConfig plant;  ///< its thermal resistance and time constant must be set
  double ambient_temperature_C = 0.0;
  double stroke_rad = 1.0;  ///< moves between 0 and this
  double interval_s = 1.0;  ///< time from one setpoint to the next
  double duration_s = 1200.0;
  double sensor_lag_s = 120.0;  ///< time constant of the late sensor
  double bias_C = 10.0;         ///< of the biased sensors, in both directions
};

/// The results with one way to know the temperature, averaged over windows of the run.
struct HeatRun {
  std::string name;
  double mean_pi2 = 0.0;                ///< per move: sum |e| / stroke
  double mean_settled_error_rad = 0.0;  ///< |e| at the end of each move
  Points pi2_over_time;                 ///< over time (s): mean of each window
  Points settled_error_over_time;       ///< rad
  Points joint_temperature_C;
  Points told_temperature_C;
};

/// Runs `table` as the daemon does (extended C4), with each way to know the temperature. Throws InputError.
std::vector<HeatRun> run_heat(const HeatConfig& config, const GainTable& table);

TextTable heat_summary(const std::vector<HeatRun>& runs);
Figure heat_figure(const std::vector<HeatRun>& runs);

}  // namespace strainwave
