// SPDX-License-Identifier: BSD-3-Clause
// Reads [joint.homing] of the configuration, see docs/configuration.md. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// Inputs that a driver offers for homing.
struct HomingInputs {
  bool home = false;
  bool negative_limit = false;
  bool positive_limit = false;
  bool index = false;
  bool counts_from_switch_on = false;  ///< positions are meaningless before the joint is homed
};

/// Reads the section into `joint`; read its limits first. Throws InputError, also if the driver lacks the input
/// that homing needs.
void read_homing(TomlSection section, const HomingInputs& available, JointConfig& joint);

}  // namespace strainwave
