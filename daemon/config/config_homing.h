// SPDX-License-Identifier: BSD-3-Clause
// [joint.homing] of the configuration, see docs/configuration.md. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// What a driver can look for.
struct HomingInputs {
  bool home = false;
  bool negative_limit = false;
  bool positive_limit = false;
  bool index = false;
  bool counts_from_switch_on = false;  ///< positions mean nothing before the joint is homed
};

/// Reads the section into `joint`, whose limits are known. Throws InputError, also when the driver lacks what
/// is looked for.
void read_homing(TomlSection section, const HomingInputs& available, JointConfig& joint);

}  // namespace strainwave
