// SPDX-License-Identifier: BSD-3-Clause
// The motion of one joint from an LCM event log, as strainwavectl identify records it. Offline.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "design/friction/steady_speed.h"

namespace strainwave {

struct FrictionLog {
  std::string joint;
  std::string joint_model;
  double inertia_kgm2 = 0.0;
  double gear_ratio = 0.0;
  std::vector<MotionSample> samples;
};

/// The states and limits of `joint`, or of the only joint in the log if `joint` is empty. Throws InputError for no
/// event log, no or several joints, no limits, several sessions of the daemon, or messages of another version.
FrictionLog read_friction_log(const std::filesystem::path& file, const std::string& joint);

}  // namespace strainwave
