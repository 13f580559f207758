// SPDX-License-Identifier: BSD-3-Clause
// A temperature and when it was: the two travel together from the sensor to the schedule. Plain data, real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

struct TemperatureSample {
  double temperature_C = 0.0;
  std::int64_t produced_ns = 0;  ///< CLOCK_MONOTONIC; no value is older than that
};

}  // namespace strainwave
