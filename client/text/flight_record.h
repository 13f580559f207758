// SPDX-License-Identifier: BSD-3-Clause
// A flight record as docs/flight-recorder.md describes it: what its head says, and gnuplot's instructions to
// draw it. Not real-time.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/csv.h"

namespace strainwave {

struct FlightRecordInfo {
  std::map<std::string, std::string> head;  ///< "joint", "fault", "fault_utc", ...
  std::map<std::string, int> columns;       ///< 1 is the first, as gnuplot counts
  double period_s = 0.0;
};

/// Reads the head. Throws InputError when the file cannot be read or is no flight record of kFlightRecordFormat with the
/// columns that the drawing needs.
FlightRecordInfo read_flight_record(const std::filesystem::path& file);

/// A number of its rows, of which "nan" is one. Throws InputError naming the row and the column.
double flight_number(const CsvText& csv, std::size_t row, std::size_t column);

/// Draws `file` into `png`; with `around_s` only so much before and after the fault.
std::string plot_script(const FlightRecordInfo& info, const std::filesystem::path& file,
                        const std::filesystem::path& png, std::optional<double> around_s);

}  // namespace strainwave
