// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/scenarios.h"

namespace strainwave {

std::string_view name(Scenario scenario) {
  return scenario == Scenario::kStaircase ? "staircase" : "ramp";
}

ClosedLoopConfig scenario_config(Scenario scenario, int range, const JointPlantConfig& plant) {
  const ProfileQuantity setpoint{"setpoint_position_rad"};
  const double start_rad = kRangeStart_rad[static_cast<std::size_t>(range)];
  ClosedLoopConfig config;
  config.plant = plant;
  if (scenario == Scenario::kStaircase) {
    config.setpoint_rad = TimeProfile::steps(start_rad, 2.0 * start_rad, 1.0, 4.0, setpoint);
    config.ambient = TemperatureProfile::sine(15.0, 25.0, 1.0);
    config.duration_s = 5.0;
  } else {
    config.setpoint_rad = TimeProfile::constant(start_rad, setpoint);
    config.ambient = TemperatureProfile::steps(-10.0, 5.0, 1.0, 11.0);
    config.duration_s = 12.0;
  }
  return config;
}

}  // namespace strainwave
