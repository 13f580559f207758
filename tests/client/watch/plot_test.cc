// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/plot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

TEST(Sparkline, IsScaledToItsLargestMagnitudeAndKeepsToAscii) {
  EXPECT_EQ(sparkline({0.0, -0.5, 1.0}, 10, 0.0, false), ".+#");
  EXPECT_EQ(sparkline({0.0, 0.5, 1.0}, 10, 0.0, true), "▁▅█");
  EXPECT_EQ(sparkline({5.0, 0.0, 1.0}, 2, 0.0, false), ".#") << "only what is shown counts";
  EXPECT_EQ(sparkline({0.0, 0.0}, 5, 0.0, false), "..");
  EXPECT_EQ(sparkline({std::nan(""), 1.0}, 5, 0.0, false), "?#");
  EXPECT_EQ(sparkline({}, 5, 0.0, true), "");
}

TEST(Sparkline, IsNotFilledByNoise) {
  EXPECT_EQ(sparkline({1e-7, -1e-7, 1e-7}, 5, 1e-4, false), "...");
}

TEST(PlotScale, HoldsTheLatestValuesAndIsNotFilledByNoise) {
  const PlotScale scale = scale_of({9.0, 1.0, 3.0}, 2, 0.5, false);
  EXPECT_EQ(scale.low, 1.0);
  EXPECT_EQ(scale.high, 3.0);
  const PlotScale noise = scale_of({1.0, 1.001}, 10, 1.0, false);
  EXPECT_NEAR(noise.high - noise.low, 1.0, 1e-12);
  EXPECT_EQ(scale_of({2.0}, 1, 0.0, true).low, 0.0);
  EXPECT_EQ(scale_of({std::nan("")}, 1, 2.0, false).high, 1.0);
}

TEST(Plot, DrawsARampFromBelowToAbove) {
  EXPECT_EQ(plot({0.0, 1.0, 2.0}, {0.0, 2.0}, 3, 3, false), (std::vector<std::string>{"  *", " **", "** "}));
  EXPECT_EQ(plot({0.0, 1.0}, {0.0, 1.0}, 1, 1, true), (std::vector<std::string>{"⣸"})) << "two by four dots";
}

TEST(Plot, KeepsItsSizeWhateverItIsGiven) {
  for (const int width : {0, 1, 7}) {
    for (const int height : {0, 1, 4}) {
      const auto lines = plot({1e300, std::nan(""), -1e300, 0.0}, {-1.0, 1.0}, width, height, false);
      EXPECT_EQ(lines.size(), width > 0 ? static_cast<std::size_t>(height) : 0U);
      for (const std::string& line : lines) EXPECT_EQ(line.size(), static_cast<std::size_t>(width));
    }
  }
}

}  // namespace
}  // namespace strainwave
