// SPDX-License-Identifier: BSD-3-Clause
// The counterparts of the figures 4-6, 8-12 and 15-20 of Zhao (2006). Offline.
#pragma once

#include <filesystem>
#include <vector>

#include "control/friction/fuzzy_friction.h"
#include "sim/studies/chapter6.h"
#include "sim/studies/figure.h"

namespace strainwave {

/// Catalogue torques and the fits, friction parameters over temperature, memberships of both layers, friction
/// over velocity. `data` is the folder of the catalogue's CSV files; `friction` the tables' fuzzy rules.
std::vector<Figure> friction_figures(const std::filesystem::path& data, const FuzzyFriction& friction);

/// Step responses, temperature steps, zoomed errors, and everything against the physical limit.
std::vector<Figure> response_figures(const Chapter6& chapter);

}  // namespace strainwave
