#include "control/handover.h"

#include <gtest/gtest.h>

#include <limits>

namespace strainwave {
namespace {

constexpr double kAll_Nm = std::numeric_limits<double>::infinity();

TEST(Handover, BeginsWithTheLastTorqueAndLeavesItForTheLaws) {
  Handover handover(1e-3);
  handover.begin(10.0);
  double last_Nm = handover.torque_Nm(-2.0, kAll_Nm);
  EXPECT_EQ(last_Nm, 10.0);
  for (int k = 1; k < 10; ++k) {
    const double now_Nm = handover.torque_Nm(-2.0, kAll_Nm);
    EXPECT_NEAR(last_Nm - now_Nm, 0.1 * (last_Nm + 2.0), 1e-12) << k;
    last_Nm = now_Nm;
  }
  for (int k = 0; k < 90; ++k) last_Nm = handover.torque_Nm(-2.0, kAll_Nm);
  EXPECT_NEAR(last_Nm, -2.0, 1e-3);
}

TEST(Handover, IsTheLawsOwnWithoutABegin) {
  Handover handover(1e-3);
  EXPECT_EQ(handover.torque_Nm(3.0, kAll_Nm), 3.0);
  handover.begin(10.0);
  handover.reset();
  EXPECT_EQ(handover.torque_Nm(3.0, kAll_Nm), 3.0);
  handover.begin(10.0);
  handover.torque_Nm(3.0, kAll_Nm);
  handover.reset();
  EXPECT_EQ(handover.torque_Nm(3.0, kAll_Nm), 3.0) << "nothing is left";
}

TEST(Handover, TakesNoMoreOfTheDifferenceThanItMay) {
  Handover handover(1e-3);
  handover.begin(10.0);
  EXPECT_EQ(handover.torque_Nm(1.0, 0.5), 1.5);
  handover.begin(-10.0);
  EXPECT_EQ(handover.torque_Nm(1.0, 0.5), 0.5);
}

TEST(Handover, IsOverAtOnceWherePeriodsAreLong) {
  Handover handover(0.02);
  handover.begin(10.0);
  EXPECT_EQ(handover.torque_Nm(0.0, kAll_Nm), 10.0);
  EXPECT_EQ(handover.torque_Nm(0.0, kAll_Nm), 0.0);
}

}  // namespace
}  // namespace strainwave
