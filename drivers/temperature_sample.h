// SPDX-License-Identifier: BSD-3-Clause
// A temperature and its time of measurement. Plain data, real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

struct TemperatureSample {
  double temperature_C = 0.0;
  std::int64_t produced_ns = 0;  ///< CLOCK_MONOTONIC; the measurement is not older than this
};

}  // namespace strainwave
