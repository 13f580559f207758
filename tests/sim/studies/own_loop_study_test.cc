// SPDX-License-Identifier: BSD-3-Clause
// Each part of the daemon's knowledge improves a drive that closes its own loop: cold and warm, at every rate of the drive.
#include "sim/studies/own_loop_study.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace strainwave {
namespace {

TEST(OwnLoopStudy, EachPartOfTheOrderMakesTheDriveBetter) {
  std::map<std::tuple<std::string, double, double>, double> rms_rad;
  // Largest ratio to the error of torque mode, for a drive with all offsets that is faster than the bus or tuned with a margin.
  constexpr double kGoal = 1.3;
  for (const OwnLoopRow& row : run_own_loops(read_flexible_tables(STRAINWAVE_SOURCE_DIR "/data/tables"))) {
    rms_rad[{row.way, row.rate_Hz, row.temperature_C}] = row.rms_rad;
    const bool faster = row.way == "all offsets" && row.rate_Hz > kDriveRates_Hz.front();
    if (faster || row.way == "all offsets, margin") {
      EXPECT_LT(row.over_torque_mode, kGoal) << row.temperature_C << " degC, " << row.rate_Hz << " Hz";
    }
  }
  for (const double rate_Hz : kDriveRates_Hz)
    for (const double temperature_C : kOwnLoopTemperatures_C) {
      const auto of = [&](const char* way) { return rms_rad.at({way, rate_Hz, temperature_C}); };
      SCOPED_TRACE(std::to_string(rate_Hz) + " Hz, " + std::to_string(temperature_C) + " degC");
      EXPECT_LT(of("plan"), of("alone"));
      EXPECT_LT(of("wind-up"), of("plan"));
      EXPECT_LT(of("all offsets"), of("wind-up"));
      EXPECT_LT(of("all offsets"), 0.5 * of("alone"));
    }
}

}  // namespace
}  // namespace strainwave
