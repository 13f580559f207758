// SPDX-License-Identifier: BSD-3-Clause
// Reads joint.limits.load_Nm, above which the joint yields, and load_notice_Nm, above which a notice is set. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// Returns the values from which the load limit of a joint without load_Nm is computed (daemon/realtime/joint/load_limits.h).
UsualLoad usual_load(const JointConfig& joint);

/// Reads both keys of [joint.limits] into `joint`. Read all other values that usual_load() uses first. Throws InputError.
void read_load_limits(TomlSection& limits, JointConfig& joint);

}  // namespace strainwave
