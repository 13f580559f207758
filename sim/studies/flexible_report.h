// SPDX-License-Identifier: BSD-3-Clause
// What the study of the flexible joint shows: in tables. Offline.
#pragma once

#include <string>
#include <vector>

#include "sim/studies/flexible_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// Every number of every cell and contender.
TextTable flexible_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders);

/// Per contender, over all of `rows`.
TextTable flexible_summary(const std::string& title, const std::vector<FlexibleRow>& rows,
                           const std::vector<Contender>& contenders);

/// What `judged`, a contender's number, costs against every other: its ratio over theirs, per step.
TextTable price_table(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                      std::size_t judged);
/// The same, every cell.
TextTable price_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                      std::size_t judged);

/// The cells in which `judged` is no better than another, and both of their ratios.
TextTable lost_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                     std::size_t judged);

/// Effects by what they cost the contender, most expensive first: geometric mean over the same cells without.
TextTable effect_ranking(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders);

}  // namespace strainwave
