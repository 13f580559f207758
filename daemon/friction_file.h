// SPDX-License-Identifier: BSD-3-Clause
// The file in which a joint's learned friction outlives the daemon: JSON, strict, bound to the joint's name and its table's friction
// rules. Pure: text in, values out. Not real-time.
//
// The learned load is not kept: what the joint carries may have changed while the daemon was away.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "control/friction/learned_friction.h"

namespace strainwave {

struct KeptFriction {
  std::string joint;
  std::int64_t friction_rules_id = 0;                ///< digest of the table's friction rules
  std::array<double, kMaxTemperatureRules> scale{};  ///< LearnedFriction::scale
  double learned_C = 0.0;                            ///< temperature at which the joint last learned
  std::int64_t learned_utime = 0;                    ///< when, us since the epoch
};

std::string to_json(const KeptFriction& kept);

/// Throws InputError that names `source`, the key, its value and what is allowed: no JSON, missing or unknown keys, a scale outside
/// [kLeastScale, kMostScale], a temperature that no joint has, a time before 1970.
KeptFriction parse_kept_friction(std::string_view text, const std::string& source);

/// Where `joint`'s is in `directory`.
std::filesystem::path friction_file(const std::filesystem::path& directory, const std::string& joint);

}  // namespace strainwave
