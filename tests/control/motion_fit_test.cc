#include "control/trajectory/motion_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double kApart_s = 0.05;

/// Of a motion at its newest sample, at `t_s`.
template <typename Motion>
void fit_to(MotionFit& fit, const Motion& motion, double t_s) {
  MotionFit::Samples ages_s{}, values{};
  for (std::size_t i = 0; i < MotionFit::kSamples; ++i) {
    // Some were lost.
    ages_s[i] = kApart_s * static_cast<double>(i + i / 4);
    values[i] = motion(t_s - ages_s[i]);
  }
  fit.fit(ages_s, values);
}
template <typename Motion>
void follow(MotionFit& fit, const Motion& motion, double missed_else) {
  for (int k = 0; k < 30; ++k) {
    const double t_s = kApart_s * k;
    fit.weigh(kApart_s, motion(t_s) - motion(t_s - kApart_s), missed_else);
    fit_to(fit, motion, t_s);
  }
}

TEST(MotionFit, IsExactForAPolynomialThatItMayBe) {
  MotionFit fit;
  fit_to(
      fit, [](double t) { return 0.3 + t * (0.7 + t * (-2.0 + t * (1.5 + t * (0.4 - 0.2 * t)))); }, 0.0);
  EXPECT_NEAR(fit.first(), 0.7, 1e-8);
  EXPECT_NEAR(fit.second(), -4.0, 1e-7);
  EXPECT_NEAR(fit.third(), 9.0, 1e-6);
}

TEST(MotionFit, HelpsWhereItMissesLessThanWhatWouldBeTakenElse) {
  const auto sine = [](double t) { return 0.5 * std::sin(3.0 * t); };
  MotionFit fit;
  EXPECT_FALSE(fit.helps()) << "nothing is known of it";
  follow(fit, sine, 1e-2);
  EXPECT_TRUE(fit.helps());
  fit.no_fit();
  EXPECT_FALSE(fit.helps());
  fit.forget();
  follow(fit, sine, 1e-9);
  EXPECT_FALSE(fit.helps());
}

TEST(MotionFit, DoesNotHelpWhereTheMotionTurnsTooOften) {
  MotionFit fit;
  follow(
      fit, [](double t) { return 0.5 * std::sin(20.0 * t); }, 0.1);
  EXPECT_FALSE(fit.helps());
}

}  // namespace
}  // namespace strainwave
