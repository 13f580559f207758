// SPDX-License-Identifier: BSD-3-Clause
// joint.limits.load_Nm and load_notice_Nm: from what load on the joint yields, and from what on there is notice. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// What the load limit of a joint follows from that is given no load_Nm (daemon/realtime/joint/load_limits.h).
UsualLoad usual_load(const JointConfig& joint);

/// Reads both of [joint.limits] into `joint`, of which all else that usual_load() asks for is known. Throws InputError.
void read_load_limits(TomlSection& limits, JointConfig& joint);

}  // namespace strainwave
