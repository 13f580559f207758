// SPDX-License-Identifier: BSD-3-Clause
// The file of a flight record: a few lines about it, then one CSV row per cycle. The format is fixed by
// kFlightRecordFormat (lcmtypes/cycle_fields.h); docs/flight-recorder.md explains every line and column. Not real-time.
#pragma once

#include <cstdint>
#include <string>

#include "daemon/realtime/loop/flight_recorder.h"

namespace strainwave {

/// Suffix of the names of all flight records; the daemon removes only files with this suffix.
inline constexpr const char* kFlightRecordSuffix = ".flight.csv";

struct FlightRecordHeader {
  std::string joint;
  std::string joint_model;
  std::int64_t session_id = 0;
  std::int64_t fault_unix_us = 0;  ///< when the fault appeared, us since the epoch
  double period_s = 0.0;
};

/// Returns the text of the whole file. `recorder` must be frozen.
std::string flight_record_text(const FlightRecordHeader& header, const FlightRecorder& recorder);

/// "elbow-20261121T030405Z-c123456-f13.flight.csv"
std::string flight_record_name(const FlightRecordHeader& header, const FlightRecorder& recorder);

}  // namespace strainwave
