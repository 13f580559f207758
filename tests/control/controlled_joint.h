// SPDX-License-Identifier: BSD-3-Clause
// The daemon's controller on the simulated joint, one period at a time. The joint's friction law differs from the controller's.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "control/joint_controller.h"
#include "control/table/gain_table_json.h"
#include "sim/joint/reference_plant.h"

namespace strainwave::testing {

inline constexpr double kCount_rad = 2.0 * std::numbers::pi / kReferenceCountsPerRevolution;

inline JointControllerConfig realistic_config() {
  const JointPlantConfig plant = realistic_plant();
  JointControllerConfig config;
  config.encoder_resolution_rad = plant.encoder.resolution_rad();
  config.delay_periods = static_cast<int>(std::lround(plant.delay.periods));
  config.torque_limit_Nm = kReferencePeakTorque_Nm;
  config.motor = plant.motor;
  config.motion = {100.0, 1e4, 1e4};
  return config;
}

/// One joint under control. Each step() is one period.
class ControlledJoint {
 public:
  explicit ControlledJoint(const JointPlantConfig& plant = realistic_plant(),
                           const JointControllerConfig& config = realistic_config(),
                           const char* table = "rhs17-6006.json", double at_C = 20.0)
      : temperature_C(at_C), plant_(plant), controller_(config) {
    controller_.load(read_gain_table(std::string(STRAINWAVE_SOURCE_DIR "/data/tables/") + table));
    plant_.set_ambient_temperature(temperature_C);
    controller_.start(plant_.measured_position_rad());
  }
  JointStep step() {
    plant_.set_ambient_temperature(temperature_C);
    JointMeasurement measurement;
    measurement.joint_position_rad =
        plant_.config().encoder.measure_rad(plant_.state().position_rad + noise_rad);
    measurement.temperature_C = temperature_C;
    measurement.temperature_valid = true;
    const JointStep result = controller_.step(measurement);
    plant_.step(result.output.torque_Nm, load_torque_Nm);
    return result;
  }
  void run(double duration_s) {
    for (int k = 0; k < static_cast<int>(duration_s * 1000.0); ++k) step();
  }
  JointController& controller() { return controller_; }
  /// True position, on a flexible joint that of the link.
  double position_rad() const { return plant_.link_state().position_rad; }

  double temperature_C;
  double load_torque_Nm = 0.0;
  double noise_rad = 0.0;  ///< error of the next readings

 private:
  JointPlant plant_;
  JointController controller_;
};

}  // namespace strainwave::testing
