// SPDX-License-Identifier: BSD-3-Clause
// Tables 8 to 11 of Zhao (2006) beside ours. Offline.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/studies/chapter6.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// What Zhao (2006) reports: data/performance_index.csv.
struct SourceIndex {
  int table = 0;
  std::string index;  ///< "PI1" or "PI2"
  std::string controller;
  std::array<double, kRangeCount> value{};
};

/// Throws InputError.
std::vector<SourceIndex> read_source_indices(const std::filesystem::path& path);

/// One table per index, scenario and setting: a row per contender, in each range our value and, in the next
/// column, the paper's where it has one; for PI2 also the ratio to the physical limit.
std::vector<TextTable> performance_tables(const Chapter6& chapter, const std::vector<SourceIndex>& source);

/// Every number of every run, one row each, for further use.
TextTable run_table(const Chapter6& chapter);

}  // namespace strainwave
