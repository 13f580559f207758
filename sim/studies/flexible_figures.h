// SPDX-License-Identifier: BSD-3-Clause
// The figures of the study of the flexible joint. Offline.
#pragma once

#include <vector>

#include "sim/studies/figure.h"
#include "sim/studies/flexible_study.h"

namespace strainwave {

/// Responses of the link, the torque's spectrum at rest, and a map of the joints that oscillate.
std::vector<Figure> flexible_figures(const std::vector<FlexibleRow>& rows,
                                     const std::vector<Contender>& contenders);

}  // namespace strainwave
