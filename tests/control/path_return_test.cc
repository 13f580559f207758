#include "control/path_return.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace strainwave {
namespace {

KnotPath path_through(std::initializer_list<PathKnot> knots) {
  KnotPath path;
  path.count = knots.size();
  std::copy(knots.begin(), knots.end(), path.knots.begin());
  return path;
}

/// There in a second, a second of rest, and back.
KnotPath there_and_back(double far_rad) {
  return path_through({{0.0, 0.0, 0.0}, {1.0, far_rad, 0.0}, {2.0, far_rad, 0.0}, {3.0, 0.0, 0.0}});
}

PathPoint at(const KnotPath& path, double time_s) {
  return PathReader().at(path, time_s);
}

TEST(PathReturn, FindsTheTimeAndTheRateOfJointsThatAreOnThePath) {
  const std::vector<KnotPath> paths{there_and_back(0.5), there_and_back(-0.2), there_and_back(0.1)};
  for (const double time_s : {0.05, 0.31, 0.8, 2.2, 2.9})
    for (const double rate : {0.0, 0.4, 1.0})
      for (const double late_s : {0.0, 0.007}) {
        std::vector<StrayJoint> joints;
        for (std::size_t i = 0; i < paths.size(); ++i) {
          const double late = i == 1 ? late_s : 0.0;
          const PathPoint point = at(paths[i], std::max(0.0, time_s - late * rate));
          joints.push_back({&paths[i], point.position_rad, point.velocity_rad_s * rate, late, {}});
        }
        const PathTime found = nearest_time(
            joints, {std::max(0.0, time_s - 0.2), std::min(3.0, time_s + 0.3), {time_s - 0.03, 1.0, 0.0}});
        EXPECT_NEAR(found.time_s, time_s, 1e-4) << time_s << ", " << rate << ", " << late_s;
        EXPECT_NEAR(found.rate, rate, 5e-3) << time_s << ", " << rate << ", " << late_s;
        EXPECT_EQ(found.rate_change_1_s, 0.0);
      }
}

TEST(PathReturn, IsTheLeastThatAllOfThemAreOff) {
  const std::vector<KnotPath> paths{there_and_back(0.5), there_and_back(0.3)};
  std::vector<StrayJoint> joints{{&paths[0], at(paths[0], 0.50).position_rad, 0.0, 0.0, {}},
                                 {&paths[1], at(paths[1], 0.54).position_rad, 0.0, 0.0, {}}};
  const double found_s = nearest_time(joints, {0.3, 0.9, {0.45, 1.0, 0.0}}).time_s;
  const auto off_rad2 = [&](double time_s) {
    double sum = 0.0;
    for (const StrayJoint& joint : joints)
      sum += std::pow(at(*joint.path, time_s).position_rad - joint.position_rad, 2);
    return sum;
  };
  for (double time_s = 0.3; time_s < 0.9; time_s += 1e-3)
    EXPECT_LE(off_rad2(found_s), off_rad2(time_s) + 1e-9) << time_s;
}

TEST(PathReturn, StaysAtTheTimeThatItWasWhereThePathRests) {
  const KnotPath path = there_and_back(0.5);
  std::vector<StrayJoint> joints{{&path, 0.5, 0.0, 0.0, {}}};
  const PathTime found = nearest_time(joints, {1.1, 1.9, {1.43, 1.0, 0.0}});
  EXPECT_NEAR(found.time_s, 1.43, 1e-3);
  EXPECT_EQ(found.rate, 1.0) << "what rests shows none";
}

TEST(PathReturn, TakesTheNearerOfTwoTimesAtWhichThePathIsAtThePlace) {
  const KnotPath path = path_through({{0.0, 0.0, 0.0}, {1.0, 0.5, 0.0}, {2.0, 0.0, 0.0}});
  const double place_rad = at(path, 0.8).position_rad;
  std::vector<StrayJoint> joints{{&path, place_rad, 0.1, 0.0, {}}};
  EXPECT_NEAR(nearest_time(joints, {0.5, 1.5, {0.85, 1.0, 0.0}}).time_s, 0.8, 1e-3);
  EXPECT_NEAR(nearest_time(joints, {0.5, 1.5, {1.15, 1.0, 0.0}}).time_s, 1.2, 1e-3);
}

TEST(PathReturn, GoesNoFasterThanThePathAndNeverBackwards) {
  const KnotPath path = there_and_back(0.5);
  const PathPoint here = at(path, 0.4);
  std::vector<StrayJoint> joints{{&path, here.position_rad, 3.0 * here.velocity_rad_s, 0.0, {}}};
  EXPECT_EQ(nearest_time(joints, {0.2, 0.7, {0.4, 0.8, 0.0}}).rate, 1.0);
  joints[0].velocity_rad_s = -0.2;
  EXPECT_EQ(nearest_time(joints, {0.2, 0.7, {0.4, 0.8, 0.0}}).rate, 0.0);
}

TEST(PathReturn, StaysInsideItsWindow) {
  const KnotPath path = there_and_back(0.5);
  std::vector<StrayJoint> joints{{&path, 0.45, 0.0, 0.0, {}}};
  EXPECT_NEAR(nearest_time(joints, {0.1, 0.3, {0.2, 1.0, 0.0}}).time_s, 0.3, 1e-4);
  EXPECT_EQ(nearest_time({}, {0.1, 0.3, {0.2, 0.7, 0.0}}).time_s, 0.2);
}

TEST(WayBack, LeadsFromPlaceAndSpeedToRestOnThePathWithoutAStep) {
  WayBack back;
  EXPECT_EQ(back.step(1e-3).position_rad, 0.0) << "none has begun";
  back.begin(0.01, -0.3, 0.2);
  PathPoint last{0.01, -0.3, 0.0};
  for (int k = 0; k < 250; ++k) {
    const PathPoint now = back.step(1e-3);
    EXPECT_NEAR(now.position_rad - last.position_rad, 0.5e-3 * (now.velocity_rad_s + last.velocity_rad_s),
                1e-7);
    EXPECT_NEAR(now.velocity_rad_s - last.velocity_rad_s,
                0.5e-3 * (now.acceleration_rad_s2 + last.acceleration_rad_s2), 2e-4);
    EXPECT_LT(std::abs(now.acceleration_rad_s2 - last.acceleration_rad_s2), 0.5);
    last = now;
  }
  EXPECT_EQ(last.position_rad, 0.0);
  EXPECT_EQ(last.velocity_rad_s, 0.0);
}

}  // namespace
}  // namespace strainwave
