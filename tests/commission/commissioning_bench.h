// SPDX-License-Identifier: BSD-3-Clause
// A random joint behind errors in its readings and commands, for the tests of commissioning.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "commission/commissioning.h"
#include "tests/commission/random_joints.h"

namespace strainwave::testing {

/// The configuration of a user with exact knowledge of the joint.
inline CommissioningConfig configure(const RandomJoint& joint) {
  const JointPlantConfig& plant = joint.drive.plant;
  CommissioningConfig config;
  config.joint = "elbow";
  config.configuration = "arm.toml";
  config.configuration_text = "[[joint]]\n";
  config.simulated = true;
  config.identity = "simulated drive";
  config.direction_key = "can.direction";
  config.excitation = joint.excitation;
  config.told = joint.told;
  ConfiguredNumbers& numbers = config.configured;
  numbers.motor_inertia_kgm2 = plant.joint.inertia_kgm2;
  numbers.load_inertia_kgm2 = plant.effects.transmission->link_inertia_kgm2;
  numbers.stiffness_1_Nm_rad = plant.effects.transmission->spring.stiffness_1_Nm_rad;
  numbers.delay_periods = static_cast<int>(std::lround(plant.delay.periods));
  numbers.delay_key = "can.delay_periods";
  numbers.gear_ratio = joint.told.gear_ratio;
  numbers.period_s = plant.period_s;
  return config;
}

/// The joint behind errors in its readings and commands.
class Bench {
 public:
  explicit Bench(const RandomJoint& joint) : drive_(joint.drive) {}

  /// Sets the ratios of the daemon's position and torque to those of the joint.
  void scale(double position, double torque) {
    position_ = position;
    torque_ = torque;
  }

  /// The drive reports the torque through a filter of this time constant.
  void filter_report(double time_s) { report_s_ = time_s; }
  void unplug_sensor() { has_sensor_ = false; }

  void period(Commissioning& commissioning) {
    ActuatorReading reading = drive_.read(now_ns_);
    now_ns_ += 1'000'000;
    speed_rad_s_ = std::max(speed_rad_s_, std::abs(drive_.plant().state().velocity_rad_s));
    reading.joint_position_rad *= position_;
    reading.torque_applied_Nm *= torque_;
    reported_Nm_ += 0.001 / (report_s_ + 0.001) * (reading.torque_applied_Nm - reported_Nm_);
    reading.torque_applied_Nm = reported_Nm_;
    reading.has_temperature = reading.has_temperature && has_sensor_;
    ActuatorCommand command = commissioning.step(reading);
    enabled_ = command.enable;
    command.torque_Nm /= torque_;
    drive_.write(command);
  }

  /// Runs to the end. Aborts the step whose line begins with `in` after `after` periods.
  void run(Commissioning& commissioning, const std::string& in = "", int after = 0) {
    while (const std::optional<std::string> line = commissioning.begin()) {
      lines_ += *line + "\n";
      const bool here = !in.empty() && line->starts_with(in);
      for (int k = 0; commissioning.moves() && k < 200'000; ++k) {
        period(commissioning);
        if (here && k == after) commissioning.abort("a key was pressed");
      }
      lines_ += commissioning.finish() + "\n";
    }
  }

  const std::string& lines() const { return lines_; }
  double speed_rad_s() const { return speed_rad_s_; }
  bool enabled() const { return enabled_; }
  double present_speed_rad_s() const { return drive_.plant().state().velocity_rad_s; }

 private:
  SimulatedActuator drive_;
  double position_ = 1.0;
  double torque_ = 1.0;
  double report_s_ = 0.0;
  double reported_Nm_ = 0.0;
  bool has_sensor_ = true;
  std::int64_t now_ns_ = 0;
  double speed_rad_s_ = 0.0;
  bool enabled_ = false;
  std::string lines_;
};

inline const CommissionStep& step_of(const CommissionRecord& record, const std::string& name) {
  for (const CommissionStep& step : record.steps)
    if (step.name == name) return step;
  throw std::runtime_error("no step " + name);
}

}  // namespace strainwave::testing
