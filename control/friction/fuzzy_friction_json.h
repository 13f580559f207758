// SPDX-License-Identifier: BSD-3-Clause
// The fuzzy friction model as a JSON object, as it stands in gain tables and friction files. Not real-time.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/strict_json.h"
#include "control/friction/fuzzy_friction.h"

namespace strainwave {

nlohmann::ordered_json fuzzy_friction_to_json(const FuzzyFriction& friction);

/// Reads what fuzzy_friction_to_json wrote: keys, types and
/// sizes; ranges are find_defect()'s. Throws InputError.
FuzzyFriction fuzzy_friction_from_json(StrictObject object);

}  // namespace strainwave
