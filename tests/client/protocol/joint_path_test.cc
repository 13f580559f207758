// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/joint_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "control/trajectory/knot_path.h"

namespace strainwave {
namespace {

KnotPath as_knots(const JointPath& part) {
  KnotPath path;
  path.count = part.knots.size();
  for (std::size_t i = 0; i < part.knots.size(); ++i)
    path.knots[i] = {part.knots[i].time_s, part.knots[i].position_rad, part.knots[i].velocity_rad_s};
  return path;
}

// Random distances and limits. The daemon accepts the path of every joint, all joints leave and arrive together, and at every instant all have
// covered the same share of their distance.
TEST(StraightPath, KeepsEveryJointsLimitsAndTheSameShareOfEveryWay) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> position(-3.0, 3.0);
  std::uniform_real_distribution<double> exponent(-5.0, 0.0);
  std::uniform_real_distribution<double> limit(0.2, 30.0);
  for (int round = 0; round < 500; ++round) {
    std::vector<StraightMove> moves;
    for (int joint = 0; joint < 6; ++joint) {
      const double from_rad = position(random);
      moves.push_back({"joint", from_rad, from_rad + position(random) * std::pow(10.0, exponent(random)),
                       limit(random), limit(random), limit(random)});
    }
    if (round % 3 == 0) moves[2].to_rad = moves[2].from_rad;
    const std::vector<JointPath> path = straight_path(moves);
    ASSERT_EQ(path.size(), moves.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
      const StraightMove& move = moves[i];
      const KnotPath knots = as_knots(path[i]);
      const PathLimits limits{{std::min(move.from_rad, move.to_rad), std::max(move.from_rad, move.to_rad)},
                              {move.speed_rad_s, move.acceleration_rad_s2, move.deceleration_rad_s2},
                              1e9,
                              1.0,
                              0.001};
      const auto defect = find_defect(knots, limits);
      ASSERT_FALSE(defect) << round << ", " << i << ": " << *defect;
      EXPECT_EQ(knots.last().position_rad, move.to_rad);
      EXPECT_EQ(knots.duration_s(), path[0].knots.back().time_s);
      PathReader first;
      PathReader own;
      const double first_way_rad = moves[0].to_rad - moves[0].from_rad;
      for (double t = 0.0; t < knots.duration_s(); t += knots.duration_s() / 17.0) {
        const double share =
            (first.at(as_knots(path[0]), t).position_rad - moves[0].from_rad) / first_way_rad;
        EXPECT_NEAR(own.at(knots, t).position_rad, move.from_rad + share * (move.to_rad - move.from_rad),
                    1e-9);
      }
    }
  }
}

TEST(StraightPath, IsAsFastAsTheJointThatTakesLongest) {
  const std::vector<JointPath> path =
      straight_path({{"a", 0.0, 1.0, 2.0, 4.0, 8.0}, {"b", 0.0, 0.1, 2.0, 4.0, 8.0}});
  // The joint reaches 2 rad/s after 0.5 s and 0.5 rad and brakes in 0.25 s and 0.25 rad, with 0.125 s between.
  EXPECT_NEAR(path[0].knots.back().time_s, 0.875, 1e-12);
  EXPECT_NEAR(path[0].knots[1].velocity_rad_s, 2.0, 1e-12);
  EXPECT_NEAR(path[1].knots[1].velocity_rad_s, 0.2, 1e-12);
}

}  // namespace
}  // namespace strainwave
