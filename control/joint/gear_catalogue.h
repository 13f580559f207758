// SPDX-License-Identifier: BSD-3-Clause
// The gears of data/gears.csv by name, with the data that programs use. The build compiles the table in, so that the daemon needs no file.
// Offline.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/joint/torsion_spring.h"

namespace strainwave {

struct Gear {
  std::string name;   ///< "csf-17-50"
  double size = 0.0;  ///< in the catalogue: pitch diameter in tenths of an inch
  double ratio = 0.0;
  TorsionSpring spring;                      ///< at the joint
  double lost_motion_rad = 0.0;              ///< at the joint, from side to side
  double repeated_peak_torque_Nm = 0.0;      ///< at the joint, for each start and stop
  double wave_generator_inertia_kgm2 = 0.0;  ///< at the motor
  std::optional<double>
      motor_running_torque_Nm;  ///< without load, 2000 RPM of the motor, 20 degC; nothing: not known
  std::optional<double> motor_starting_torque_Nm;  ///< without load; nothing: not known
};

/// Every gear, in the file's order.
const std::vector<Gear>& gear_catalogue();

/// The names, for messages: "csf-14-50, csf-17-50, ...".
std::string gear_names();

/// The gear of this name; null when there is none.
const Gear* find_gear(std::string_view name);

}  // namespace strainwave
