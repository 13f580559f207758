// SPDX-License-Identifier: BSD-3-Clause
// Reads the head of a flight record (docs/flight-recorder.md), and writes a gnuplot script that draws it. Not
// real-time.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/csv.h"

namespace strainwave {

struct FlightRecordInfo {
  std::map<std::string, std::string> head;  ///< "joint", "fault", "fault_utc", ...
  std::map<std::string, int> columns;       ///< column numbers from 1, as in gnuplot
  double period_s = 0.0;
};

/// Reads the head. Throws InputError when the file cannot be read, or is not a flight record of
/// kFlightRecordFormat with the columns of the drawing.
FlightRecordInfo read_flight_record(const std::filesystem::path& file);

/// A number of a row; "nan" counts as a number. Throws InputError that names the row and the column.
double flight_number(const CsvText& csv, std::size_t row, std::size_t column);

/// The gnuplot script that draws `file` to `png`; with `around_s` only this time before and after the fault.
std::string plot_script(const FlightRecordInfo& info, const std::filesystem::path& file,
                        const std::filesystem::path& png, std::optional<double> around_s);

}  // namespace strainwave
