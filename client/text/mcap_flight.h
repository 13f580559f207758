// SPDX-License-Identifier: BSD-3-Clause
// A flight record (docs/flight-recorder.md) as an MCAP file: one topic, a JSON message for each cycle. Not real-time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace strainwave {

/// Whether the first line of `file` is that of a flight record, of any format.
bool is_flight_record(const std::filesystem::path& file);

struct FlightMcap {
  std::string topic;  ///< "<joint>.FLIGHT"
  std::uint64_t messages = 0;
};

/// Times are those of the wall clock, which the record knows to the second of its fault. Ids of senders and keys are texts, modes and
/// faults come a second time as words, and tracking_error_rad is the setpoint less the position at one instant; a number that is none is
/// null. Throws InputError for what is no complete record, and when `mcap` cannot be written.
FlightMcap write_flight_mcap(const std::filesystem::path& file, const std::filesystem::path& mcap);

}  // namespace strainwave
