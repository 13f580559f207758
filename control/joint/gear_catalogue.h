// SPDX-License-Identifier: BSD-3-Clause
// The gears of data/gears.csv by name. The table is compiled in, so that the daemon needs no file for it. Offline.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/joint/torsion_spring.h"

namespace strainwave {

struct Gear {
  std::string name;  ///< "csf-17-50"
  double ratio = 0.0;
  TorsionSpring spring;
  double accuracy_rad = 0.0;          ///< largest kinematic error, one way
  double lost_motion_rad = 0.0;       ///< hysteresis loss
  double ratcheting_torque_Nm = 0.0;  ///< at which teeth slip
};

/// Every gear, in the file's order.
const std::vector<Gear>& gear_catalogue();

/// The names, for messages: "csf-14-50, csf-17-50, ...".
std::string gear_names();

/// The gear of this name; null when there is none.
const Gear* find_gear(std::string_view name);

}  // namespace strainwave
