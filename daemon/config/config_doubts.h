// SPDX-License-Identifier: BSD-3-Clause
// Finds values that are allowed but probably wrong: degrees in place of radians, or a supervision that is switched off. They stay
// valid, since some joint may need them. The daemon at its start and strainwaved --check warn of them. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/toml_section.h"
#include "base/units.h"
#include "control/table/gain_table.h"
#include "daemon/config/config.h"
#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/loop/loop_parts.h"

namespace strainwave {

/// Warns that the angle of `key` may be in degrees if it exceeds `usual_rad`. The default, a turn, suits positions.
void doubt_angle(const TomlSection& section, std::string_view key, double angle_rad,
                 double usual_rad = kTurn_rad);

/// Returns "; if degrees Fahrenheit are meant, write 70" for a limit that no motor withstands, else an empty text.
std::string fahrenheit_hint(double limit_C);

/// Checks [joint.limits], already read into `loop`, of a joint with this gear ratio.
void doubt_limits(const TomlSection& section, const JointLoopConfig& loop, double gear_ratio);

/// Warns of an inertia in [[joint]] that the torque limit cannot accelerate with acceleration_rad_s2.
void doubt_inertia(const TomlSection& section, const JointConfig& joint);

/// Checks a joint's torque limit, the smaller of configuration and table. Returns a warning if the table's friction and the configured
/// gravity leave so little of it that the joint hardly moves or does not move at all.
std::vector<std::string> doubt_torque(const std::string& joint, const JointControllerConfig& controller,
                                      const GainTable& table);

/// Checks [daemon], already read into `loop`. `usual_stall_s`: the default of stall_limit_s.
void doubt_loop(const TomlSection& section, const LoopConfig& loop, double usual_stall_s);

/// Checks the folder that `key` names, which the daemon creates at the first write. Warns if this user cannot create it or write into
/// it, or if other users can write into it.
void doubt_folder(const TomlSection& section, std::string_view key, const std::filesystem::path& folder);

}  // namespace strainwave
