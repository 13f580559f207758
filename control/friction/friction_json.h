// SPDX-License-Identifier: BSD-3-Clause
// Friction as JSON, as it stands in gain tables and in the friction files of strainwave-design fit: at one temperature, over temperature and
// speed as one law, and as fuzzy rules. Joint side. Not real-time. Whatever reads throws InputError.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "base/strict_json.h"
#include "control/friction/fuzzy_friction.h"

namespace strainwave {

nlohmann::ordered_json friction_parameters_to_json(const FrictionParameters& parameters);
/// Reads their keys of `object`, which may have more.
FrictionParameters friction_parameters_from_json(StrictObject& object);

/// Reads the law's keys of `object`, which may have more.
FrictionLaw friction_law_from_json(StrictObject& object);

/// The law of a friction file of strainwave-design fit. It must have one, for this ratio.
FrictionLaw read_friction_law(const std::filesystem::path& path, double gear_ratio);

nlohmann::ordered_json fuzzy_friction_to_json(const FuzzyFriction& friction);
/// Reads what fuzzy_friction_to_json wrote: keys, types and sizes; ranges are find_defect()'s.
FuzzyFriction fuzzy_friction_from_json(StrictObject object);

}  // namespace strainwave
