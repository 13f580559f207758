// SPDX-License-Identifier: BSD-3-Clause
// The same gains on joints drawn at random around the one that they were designed for. On a flexible joint the link's inertia
// varies, and the link is judged. Each draw depends only on the seed and its number, so that it can be repeated alone. Offline.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/studies/contenders.h"
#include "sim/studies/figure.h"
#include "sim/studies/text_table.h"

namespace strainwave {

struct RobustnessConfig {
  JointPlantConfig plant;  ///< nominal
  int draws = 200;         ///< 1..100000
  std::uint64_t seed = 1;
  double inertia_spread = 0.3;        ///< relative, uniform in [1 - spread, 1 + spread], in [0, 1)
  double friction_spread = 0.3;       ///< relative, one factor for all of friction
  double payload_inertia_kgm2 = 0.0;  ///< added, uniform in [0, value]
  double payload_torque_Nm = 0.0;     ///< constant load, uniform in [-value, value]
  double temperature_min_C = -10.0;   ///< constant ambient temperature of each draw, uniform
  double temperature_max_C = 45.0;
  double setpoint_rad = 0.1;
  double duration_s = 2.0;
};

/// One joint, and the results of each contender on it.
struct RobustnessDraw {
  double inertia_kgm2 = 0.0;  ///< motor and link together
  double friction_factor = 1.0;
  double load_torque_Nm = 0.0;
  double temperature_C = 0.0;
  double limit_pi2 = 0.0;  ///< limit of this joint under its load
  std::vector<LoopStatistics> statistics;
  std::vector<bool> diverged;
};

/// Runs every contender on every draw, on all cores. Throws InputError.
std::vector<RobustnessDraw> run_robustness(const RobustnessConfig& config,
                                           const std::vector<Contender>& contenders);

/// Tables of each draw, and of percentiles per contender.
TextTable robustness_table(const std::vector<RobustnessDraw>& draws,
                           const std::vector<Contender>& contenders);
TextTable robustness_summary(const std::vector<RobustnessDraw>& draws,
                             const std::vector<Contender>& contenders);

/// Distribution of PI2 over the limit and of the final error, and that ratio over inertia and over friction.
Figure robustness_figure(const std::vector<RobustnessDraw>& draws, const std::vector<Contender>& contenders);

}  // namespace strainwave
