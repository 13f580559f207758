// SPDX-License-Identifier: BSD-3-Clause
// What a configuration may say and yet rarely means: degrees where radians are asked for, a supervision that is switched off. It is
// not refused, since some joint may want it; the daemon says so at its start, and strainwaved --check. Not real-time.
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

/// Notes a doubt when the angle that `key` gives is larger than it usually is, of a position a turn: it may be meant in degrees.
void doubt_angle(const TomlSection& section, std::string_view key, double angle_rad,
                 double usual_rad = kTurn_rad);

/// What a limit is in degrees Celsius that no motor bears: "; if degrees Fahrenheit are meant, write 70". Else nothing.
std::string fahrenheit_hint(double limit_C);

/// Of [joint.limits], already read into `loop`, of a joint behind such a gear.
void doubt_limits(const TomlSection& section, const JointLoopConfig& loop, double gear_ratio);

/// Of [[joint]]: an inertia that the torque limit can never accelerate as acceleration_rad_s2 has it.
void doubt_inertia(const TomlSection& section, const JointConfig& joint);

/// Of a joint's torque limit, the smaller of configuration and table: where the table's friction and the configured gravity leave so little
/// of it that the joint hardly moves or does not move at all.
std::vector<std::string> doubt_torque(const std::string& joint, const JointControllerConfig& controller,
                                      const GainTable& table);

/// Of [daemon], already read into `loop`.
void doubt_loop(const TomlSection& section, const LoopConfig& loop);

/// Of the folder that `key` names, which is made when something is written: that this user cannot make it or write into it; or that
/// other users can, too.
void doubt_folder(const TomlSection& section, std::string_view key, const std::filesystem::path& folder);

}  // namespace strainwave
