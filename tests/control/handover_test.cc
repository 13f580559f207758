#include "control/handover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

TEST(Handover, BeginsWithTheLastTorqueAndLeavesItForTheLaws) {
  Handover handover(1e-3);
  handover.begin(10.0, false);
  double last_Nm = handover.torque_Nm(-2.0);
  EXPECT_EQ(last_Nm, 10.0);
  for (int k = 1; k < 50; ++k) {
    const double now_Nm = handover.torque_Nm(-2.0);
    EXPECT_LE(std::abs(now_Nm - last_Nm), 0.4 * 12.0 + 1e-9) << k;
    last_Nm = now_Nm;
  }
  EXPECT_NEAR(last_Nm, -2.0, 0.01);
}

TEST(Handover, LeavesOverAHundredthOfASecondWhereAMotionGoesOn) {
  Handover handover(1e-3);
  handover.begin(10.0, true);
  double last_Nm = handover.torque_Nm(-2.0);
  EXPECT_EQ(last_Nm, 10.0);
  for (int k = 1; k < 10; ++k) {
    const double now_Nm = handover.torque_Nm(-2.0);
    EXPECT_NEAR(last_Nm - now_Nm, 0.1 * (last_Nm + 2.0), 1e-12) << k;
    last_Nm = now_Nm;
  }
}

// What it pushes it brakes again: a mass without friction is displaced and stands.
TEST(Handover, DisplacesAFreeMassByNoMoreThanItsTimeSquaredAndLeavesItAtRest) {
  for (const double period_s : {0.25e-3, 1e-3, 2e-3, 20e-3}) {
    Handover handover(period_s);
    handover.begin(10.0, false);
    double momentum_Nms = 0.0;
    double displaced_Nms2 = 0.0;
    for (int k = 0; k < 400; ++k) {
      momentum_Nms += period_s * handover.torque_Nm(0.0);
      displaced_Nms2 += period_s * momentum_Nms;
    }
    const double time_s = std::max(5e-3, 5.0 * period_s);
    EXPECT_NEAR(momentum_Nms, 0.0, 1e-6 * time_s * 10.0) << period_s;
    EXPECT_LE(displaced_Nms2, 10.0 * time_s * time_s * 1.001) << period_s;
    EXPECT_GT(displaced_Nms2, 0.0) << period_s;
  }
}

TEST(Handover, IsTheLawsOwnWithoutABegin) {
  Handover handover(1e-3);
  EXPECT_EQ(handover.torque_Nm(3.0), 3.0);
  handover.begin(10.0, true);
  handover.reset();
  EXPECT_EQ(handover.torque_Nm(3.0), 3.0);
  handover.begin(10.0, true);
  handover.torque_Nm(3.0);
  handover.reset();
  EXPECT_EQ(handover.torque_Nm(3.0), 3.0) << "nothing is left";
}

TEST(Handover, BegunAnewForgetsWhatWasLeft) {
  Handover handover(1e-3);
  handover.begin(10.0, true);
  handover.torque_Nm(0.0);
  handover.torque_Nm(0.0);
  handover.begin(4.0, false);
  EXPECT_EQ(handover.torque_Nm(4.0), 4.0);
  EXPECT_EQ(handover.torque_Nm(4.0), 4.0);
}

}  // namespace
}  // namespace strainwave
