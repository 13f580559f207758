// SPDX-License-Identifier: BSD-3-Clause
// The load of a CAN bus: the worst-case length of each frame, with bit stuffing, times its rate. Pure
// functions. Source: ISO 11898-1; K. Tindell et al., "Calculating controller area network message response
// times" (1995), as corrected by R. Davis et al. (2007), equation 1.
#pragma once

#include <string>
#include <vector>

namespace strainwave {

/// Bits of a data frame with an 11-bit identifier and `bytes` of data, including the gap after it and
/// worst-case stuffing.
constexpr int worst_case_frame_bits(int bytes) noexcept {
  return 47 + 8 * bytes + (34 + 8 * bytes - 1) / 4;
}

struct FrameTraffic {
  std::string what;  ///< for the log: "SYNC", "RPDO1 of elbow"
  int bytes = 0;
  double rate_Hz = 0.0;
};

/// Returns the share of the bus's time in use; 1: full.
double bus_load(const std::vector<FrameTraffic>& traffic, double bit_rate);

/// Returns a text like "can0: 78.0 % of 1000000 bit/s in use at worst: SYNC 5.5, ...".
std::string bus_load_text(const std::string& bus, const std::vector<FrameTraffic>& traffic, double bit_rate);

/// Throws InputError with the figures and remedies when the load is above `limit`.
void require_bus_load(const std::string& bus, const std::vector<FrameTraffic>& traffic, double bit_rate,
                      double limit);

}  // namespace strainwave
