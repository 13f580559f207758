#include "control/current_loop.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kCommanded_Nm = 10.0;
constexpr double kActing_Nm = -4.0;

struct Integrated {
  double mean_Nm = 0.0;
  double end_Nm = 0.0;
};

// i' = (u - i) / tau in fine steps.
Integrated integrated(double time_constant_s) {
  constexpr int kSteps = 200000;
  Integrated result{0.0, kActing_Nm};
  for (int k = 0; k < kSteps; ++k) {
    const double middle_Nm =
        result.end_Nm + 0.5 * kPeriod_s / kSteps / time_constant_s * (kCommanded_Nm - result.end_Nm);
    result.mean_Nm += middle_Nm / kSteps;
    result.end_Nm += kPeriod_s / kSteps / time_constant_s * (kCommanded_Nm - middle_Nm);
  }
  return result;
}

TEST(CurrentLoop, IsTheLagOfFirstOrder) {
  for (const double time_constant_s : {1e-4, 3e-4, 1e-3, 5e-3}) {
    const CurrentLoop loop(time_constant_s, kPeriod_s);
    const Integrated expected = integrated(time_constant_s);
    EXPECT_NEAR(loop.mean_Nm(kCommanded_Nm, kActing_Nm), expected.mean_Nm, 1e-6) << time_constant_s;
    EXPECT_NEAR(loop.end_Nm(kCommanded_Nm, kActing_Nm), expected.end_Nm, 1e-6) << time_constant_s;
  }
}

TEST(CurrentLoop, ACommandForAMeanMakesThatMean) {
  for (const double time_constant_s : {0.0, 1e-5, 3e-4, 1e-3, 5e-3}) {
    const CurrentLoop loop(time_constant_s, kPeriod_s);
    const double command_Nm = loop.command_Nm(7.0, kActing_Nm);
    EXPECT_NEAR(loop.mean_Nm(command_Nm, kActing_Nm), 7.0, 1e-9) << time_constant_s;
  }
}

// One command undoes what the last has left; the next must not swing up.
TEST(CurrentLoop, CommandsForTheSameMeanComeToIt) {
  for (const double time_constant_s : {3e-4, 1e-3, 5e-3}) {
    const CurrentLoop loop(time_constant_s, kPeriod_s);
    double acting_Nm = kActing_Nm;
    for (int k = 0; k < 400; ++k) acting_Nm = loop.end_Nm(loop.command_Nm(7.0, acting_Nm), acting_Nm);
    EXPECT_NEAR(acting_Nm, 7.0, 1e-3) << time_constant_s;
  }
}

TEST(CurrentLoop, WithoutALagWhatIsCommandedActs) {
  const CurrentLoop loop(0.0, kPeriod_s);
  EXPECT_FALSE(loop.lags());
  EXPECT_EQ(loop.mean_Nm(kCommanded_Nm, kActing_Nm), kCommanded_Nm);
  EXPECT_EQ(loop.end_Nm(kCommanded_Nm, kActing_Nm), kCommanded_Nm);
  EXPECT_EQ(loop.command_Nm(kCommanded_Nm, kActing_Nm), kCommanded_Nm);
}

}  // namespace
}  // namespace strainwave
