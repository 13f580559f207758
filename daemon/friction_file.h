// SPDX-License-Identifier: BSD-3-Clause
// The file that keeps a joint's learned friction while the daemon is off: strict JSON, bound to the joint's name and its table's
// friction rules. Pure: text in, values out. Not real-time.
//
// The learned load is not kept, because the joint may carry another load after a restart.
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
  double learned_C = 0.0;                            ///< temperature when the joint last learned
  std::int64_t learned_utime = 0;                    ///< time when it last learned, us since the epoch
};

std::string to_json(const KeptFriction& kept);

/// Throws InputError for malformed JSON, missing or unknown keys, a scale outside [kLeastScale, kMostScale], a temperature outside
/// [-273.15, 1000] degC, and a time before 1970. The error names `source`, the key, its value and what is allowed.
KeptFriction parse_kept_friction(std::string_view text, const std::string& source);

/// Returns the path of the file for `joint` in `directory`.
std::filesystem::path friction_file(const std::filesystem::path& directory, const std::string& joint);

}  // namespace strainwave
