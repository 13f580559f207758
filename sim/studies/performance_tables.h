// SPDX-License-Identifier: BSD-3-Clause
// Tables 8 to 11 of Zhao (2006) beside the results of this project. Offline.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/studies/chapter6.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// One row of the results of Zhao (2006): data/performance_index.csv.
struct SourceIndex {
  int table = 0;
  std::string index;  ///< "PI1" or "PI2"
  std::string controller;
  std::array<double, kRangeCount> value{};
};

/// Throws InputError.
std::vector<SourceIndex> read_source_indices(const std::filesystem::path& path);

/// One table per index, scenario and setting, with a row per contender. For each range it shows this
/// project's value, the paper's if there is one, and for PI2 the ratio to the physical limit.
std::vector<TextTable> performance_tables(const Chapter6& chapter, const std::vector<SourceIndex>& source);

/// All numbers of all runs, one row per run, for further use.
TextTable run_table(const Chapter6& chapter);

}  // namespace strainwave
