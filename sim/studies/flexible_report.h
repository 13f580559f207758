// SPDX-License-Identifier: BSD-3-Clause
// The tables of the study of the flexible joint. Offline.
#pragma once

#include <string>
#include <vector>

#include "sim/studies/flexible_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// Every number of every cell and contender.
TextTable flexible_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders);

/// Summary per contender, over all of `rows`.
TextTable flexible_summary(const std::string& title, const std::vector<FlexibleRow>& rows,
                           const std::vector<Contender>& contenders);

/// The price of contender number `judged` against every other: its ratio to the limit over theirs, per step.
TextTable price_table(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                      std::size_t judged);
/// The same for every cell.
TextTable price_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                      std::size_t judged);

/// The cells in which `judged` is no better than another contender, with the ratios of both.
TextTable lost_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                     std::size_t judged);

/// Effects ordered by the geometric mean of the daemon's ratio to the limit, the most expensive first.
TextTable effect_ranking(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders);

}  // namespace strainwave
