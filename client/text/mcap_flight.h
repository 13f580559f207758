// SPDX-License-Identifier: BSD-3-Clause
// Converts a flight record (docs/flight-recorder.md) to an MCAP file: one topic, with a JSON message for each cycle. Not real-time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace strainwave {

/// Whether the first line of `file` marks a flight record, of any format version.
bool is_flight_record(const std::filesystem::path& file);

struct FlightMcap {
  std::string topic;  ///< "<joint>.FLIGHT"
  std::uint64_t messages = 0;
};

/// Times are wall-clock times; the record knows the time of its fault to the second. Ids of senders and keys
/// are texts. Modes and faults are repeated as words. tracking_error_rad is setpoint - position at one
/// instant. NaN becomes null. Throws InputError for an incomplete record, and when `mcap` cannot be written.
FlightMcap write_flight_mcap(const std::filesystem::path& file, const std::filesystem::path& mcap);

}  // namespace strainwave
