// SPDX-License-Identifier: BSD-3-Clause
// What the study of the flexible joint shows, in figures. Offline.
#pragma once

#include <vector>

#include "sim/studies/figure.h"
#include "sim/studies/flexible_study.h"

namespace strainwave {

/// Responses of the link, the torque's spectrum at rest, and where it oscillates.
std::vector<Figure> flexible_figures(const std::vector<FlexibleRow>& rows,
                                     const std::vector<Contender>& contenders);

}  // namespace strainwave
