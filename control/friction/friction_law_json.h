// SPDX-License-Identifier: BSD-3-Clause
// Friction at one temperature, and over temperature and speed as one law, as strainwave-design fit writes it into a friction file. Joint side. Not real-time.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "base/strict_json.h"
#include "control/friction/friction.h"

namespace strainwave {

nlohmann::ordered_json friction_parameters_to_json(const FrictionParameters& parameters);
/// Reads their keys of `object`, which may have more. Throws InputError.
FrictionParameters friction_parameters_from_json(StrictObject& object);

/// Reads the law's keys of `object`, which may have more. Throws InputError.
FrictionLaw friction_law_from_json(StrictObject& object);

/// The law of a friction file of strainwave-design fit. Throws InputError where it has none, or is for another ratio.
FrictionLaw read_friction_law(const std::filesystem::path& path, double gear_ratio);

}  // namespace strainwave
