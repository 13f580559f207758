// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/notch_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kFrequency_rad_s = 500.0;

/// Gain of the filter for a sine, after the transient.
double gain_at(double frequency_rad_s, double width_share) {
  NotchFilter notch(kFrequency_rad_s, width_share, kPeriod_s);
  double largest = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double output = notch.step(std::sin(frequency_rad_s * kPeriod_s * k));
    if (k >= 10000) largest = std::max(largest, std::abs(output));
  }
  return largest;
}

TEST(NotchFilter, PassesAConstantWhole) {
  NotchFilter notch(kFrequency_rad_s, 0.5, kPeriod_s);
  double output = 0.0;
  for (int k = 0; k < 1000; ++k) output = notch.step(3.0);
  EXPECT_NEAR(output, 3.0, 1e-12);
}

TEST(NotchFilter, LeavesNothingOfItsFrequency) {
  for (const double width_share : {0.1, 0.5, 1.4}) EXPECT_LT(gain_at(kFrequency_rad_s, width_share), 1e-9);
}

// The edges f of  (w^2 - f^2)^2 = (b w f)^2, before the frequencies are warped.
TEST(NotchFilter, IsAsWideAsItIsTold) {
  const double share = 0.2;
  const auto warped = [](double f) { return 2.0 / kPeriod_s * std::atan(0.5 * kPeriod_s * f); };
  const double middle = 2.0 / kPeriod_s * std::tan(0.5 * kPeriod_s * kFrequency_rad_s);
  const double half = 0.5 * share * middle;
  const double root = std::sqrt(middle * middle + half * half);
  EXPECT_NEAR(gain_at(warped(root - half), share), std::sqrt(0.5), 2e-3);
  EXPECT_NEAR(gain_at(warped(root + half), share), std::sqrt(0.5), 2e-3);
  EXPECT_GT(gain_at(0.3 * kFrequency_rad_s, share), 0.99);
}

TEST(NotchFilter, IsLateByItsWidthForWhatIsSlow) {
  const double share = 0.5;
  NotchFilter notch(kFrequency_rad_s, share, kPeriod_s);
  double output = 0.0;
  for (int k = 0; k <= 1000; ++k) output = notch.step(kPeriod_s * k);
  EXPECT_NEAR(1.0 - output, share / kFrequency_rad_s, 1e-4);
}

TEST(NotchFilter, ForgetsWhatItWasGiven) {
  NotchFilter notch(kFrequency_rad_s, 0.5, kPeriod_s);
  const double first = notch.step(1.0);
  notch.step(7.0);
  notch.reset();
  EXPECT_EQ(notch.step(1.0), first);
}

}  // namespace
}  // namespace strainwave
