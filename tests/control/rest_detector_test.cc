#include "control/rest_detector.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kCount_rad = 2e-5;

void settle(RestDetector& detector) {
  for (int k = 0; k < 10; ++k) detector.update(0.0, 0.0);
}

TEST(RestDetector, RestsOnlyAfterTheReadingHasStoodStillForTenSamples) {
  RestDetector detector(kCount_rad);
  for (int k = 0; k < 9; ++k) EXPECT_FALSE(detector.update(0.0, 0.0)) << k;
  EXPECT_TRUE(detector.update(0.0, 0.0));
}

TEST(RestDetector, OneMovingSampleBeginsTheCountAnew) {
  RestDetector detector(kCount_rad);
  for (int k = 0; k < 9; ++k) detector.update(0.0, 0.0);
  EXPECT_FALSE(detector.update(0.0, 0.02));
  for (int k = 0; k < 9; ++k) EXPECT_FALSE(detector.update(0.0, 0.0)) << k;
}

TEST(RestDetector, ACountAwayItNeitherBeginsNorEndsToRest) {
  RestDetector away(kCount_rad);
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(away.update(1.2 * kCount_rad, 0.0)) << k;
  RestDetector resting(kCount_rad);
  settle(resting);
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(resting.update(-1.2 * kCount_rad, 0.5)) << k;
}

TEST(RestDetector, LeavesRestWhenTheJointIsTwoCountsAway) {
  for (const double side : {-1.0, 1.0}) {
    RestDetector detector(kCount_rad);
    settle(detector);
    EXPECT_FALSE(detector.update(side * 2.0 * kCount_rad, 0.0));
    EXPECT_FALSE(detector.update(0.0, 0.0)) << "and must stand still again";
  }
}

TEST(RestDetector, ExactSensingRestsWithinItsWindow) {
  RestDetector inside(0.0);
  for (int k = 0; k < 10; ++k) inside.update(0.9 * kExactRestWindow_rad, 0.0);
  EXPECT_TRUE(inside.update(0.9 * kExactRestWindow_rad, 0.0));
  RestDetector outside(0.0);
  for (int k = 0; k < 30; ++k) EXPECT_FALSE(outside.update(1.1 * kExactRestWindow_rad, 0.0));
}

TEST(RestDetector, ForgetsWhenItIsReset) {
  RestDetector detector(kCount_rad);
  settle(detector);
  detector.reset();
  EXPECT_FALSE(detector.update(0.0, 0.0));
}

}  // namespace
}  // namespace strainwave
