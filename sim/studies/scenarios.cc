#include "sim/studies/scenarios.h"

#include "sim/joint/reference_plant.h"

namespace strainwave {

std::string_view name(Scenario scenario) {
  return scenario == Scenario::kStaircase ? "staircase" : "ramp";
}

std::string_view name(Setting setting) {
  switch (setting) {
    case Setting::kIdeal:
      return "ideal";
    case Setting::kLimited:
      return "limited";
    case Setting::kRealistic:
      break;
  }
  return "realistic";
}

JointPlantConfig setting_plant(Setting setting) {
  switch (setting) {
    case Setting::kIdeal:
      return ideal_plant();
    case Setting::kLimited:
      return torque_limited_plant();
    case Setting::kRealistic:
      break;
  }
  return realistic_plant();
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
