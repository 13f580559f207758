// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/knot_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace strainwave {
namespace {

bool names(const std::optional<std::string>& defect, const std::string& what) {
  return defect && defect->find(what) != std::string::npos;
}

KnotPath make_path(const std::vector<PathKnot>& knots) {
  KnotPath path;
  path.count = knots.size();
  std::copy_n(knots.begin(), std::min(knots.size(), KnotPath::kMostKnots), path.knots.begin());
  return path;
}

/// Random knots at irregular times; the path rests at both ends.
KnotPath random_path(std::mt19937& random, std::size_t count = 9) {
  std::uniform_real_distribution<double> interval(0.05, 0.6);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  std::uniform_real_distribution<double> velocity(-2.0, 2.0);
  std::vector<PathKnot> knots{{0.0, position(random), 0.0}};
  while (knots.size() < count)
    knots.push_back({knots.back().time_s + interval(random), position(random), velocity(random)});
  knots.back().velocity_rad_s = 0.0;
  return make_path(knots);
}

PathLimits wide() {
  return {{-1e6, 1e6}, {1e6, 1e6, 1e6}, 1e9, 0.5, 1e-3};
}

/// Range, speed and accelerations that a path needs, from about 4000 instants of each segment and more near its knots.
struct Needs {
  double min_rad = 1e9, max_rad = -1e9, speed = 0.0, growing = 0.0, falling = 0.0;
  void see(const Reference& p) {
    min_rad = std::min(min_rad, p.position_rad);
    max_rad = std::max(max_rad, p.position_rad);
    speed = std::max(speed, std::abs(p.velocity_rad_s));
    double& side = p.velocity_rad_s * p.acceleration_rad_s2 > 0.0 ? growing : falling;
    side = std::max(side, std::abs(p.acceleration_rad_s2));
  }
};
Needs needs_of(const KnotPath& path) {
  Needs needs;
  for (std::size_t i = 0; i + 1 < path.count; ++i) {
    const double begin_s = path.knots[i].time_s;
    const double length_s = path.knots[i + 1].time_s - begin_s;
    const auto see = [&](double share) {
      PathReader reader;
      needs.see(reader.at(path, begin_s + share * length_s));
    };
    for (int k = 1; k < 4000; ++k) see(k / 4000.0);
    for (double close = 0.5; close > 1e-7; close *= 0.6) {
      see(close);
      see(1.0 - close);
    }
  }
  return needs;
}

TEST(KnotPath, PassesThroughItsKnotsWithTheirVelocities) {
  std::mt19937 random(1);
  const KnotPath path = random_path(random);
  PathReader reader;
  for (std::size_t i = 0; i < path.count; ++i) {
    const Reference at = reader.at(path, path.knots[i].time_s);
    EXPECT_NEAR(at.position_rad, path.knots[i].position_rad, 1e-12);
    EXPECT_NEAR(at.velocity_rad_s, path.knots[i].velocity_rad_s, 1e-12);
  }
}

TEST(KnotPath, VelocityAndAccelerationAreTheDerivatives) {
  std::mt19937 random(3);
  const KnotPath path = random_path(random);
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i + 1 < path.count; ++i) {
    const double t = 0.5 * (path.knots[i].time_s + path.knots[i + 1].time_s);
    PathReader reader;
    const Reference before = reader.at(path, t - kStep);
    const Reference at = reader.at(path, t);
    const Reference after = reader.at(path, t + kStep);
    EXPECT_NEAR((after.position_rad - before.position_rad) / (2 * kStep), at.velocity_rad_s, 1e-6);
    EXPECT_NEAR((after.velocity_rad_s - before.velocity_rad_s) / (2 * kStep), at.acceleration_rad_s2, 1e-5);
  }
}

TEST(KnotPath, ReadInStepsItIsTheSameAsReadAtOnceAndRestsAfterItsEnd) {
  std::mt19937 random(4);
  const KnotPath path = random_path(random, KnotPath::kMostKnots);
  PathReader forwards;
  for (double t = 0.0; t < path.duration_s(); t += 0.0137) {
    PathReader fresh;
    EXPECT_EQ(forwards.at(path, t).position_rad, fresh.at(path, t).position_rad);
  }
  const Reference end = forwards.at(path, path.duration_s() + 1.0);
  EXPECT_EQ(end.position_rad, path.last().position_rad);
  EXPECT_EQ(end.velocity_rad_s, 0.0);
  EXPECT_EQ(end.acceleration_rad_s2, 0.0);
}

// A check of the knots alone would miss these needs. On random paths find_defect() agrees with a dense sampling of the path.
TEST(KnotPath, IsRefusedForExactlyWhatItNeedsBetweenItsKnots) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const KnotPath path = random_path(random);
    const Needs needs = needs_of(path);
    const auto least = [&](double share) {
      PathLimits limits = wide();
      limits.range = {needs.min_rad - (share - 1.0), needs.max_rad + (share - 1.0)};
      limits.motion = {share * needs.speed, share * needs.growing, share * needs.falling};
      limits.torque_Nm = share * limits.inertia_kgm2 * std::max(needs.growing, needs.falling);
      return limits;
    };
    ASSERT_EQ(find_defect(path, least(1.001)), std::nullopt) << i;
    const PathLimits little = least(0.999);
    PathLimits limits = wide();
    limits.range.min_rad = little.range.min_rad;
    EXPECT_TRUE(names(find_defect(path, limits), "position_rad = ")) << i;
    limits = wide();
    limits.range.max_rad = little.range.max_rad;
    EXPECT_TRUE(names(find_defect(path, limits), "position_rad = ")) << i;
    limits = wide();
    limits.motion.velocity_rad_s = little.motion.velocity_rad_s;
    EXPECT_TRUE(names(find_defect(path, limits), "speed in rad/s = ")) << i;
    limits = wide();
    limits.motion.acceleration_rad_s2 = little.motion.acceleration_rad_s2;
    EXPECT_TRUE(names(find_defect(path, limits), "joint.limits.acceleration_rad_s2")) << i;
    limits = wide();
    limits.motion.deceleration_rad_s2 = little.motion.deceleration_rad_s2;
    EXPECT_TRUE(names(find_defect(path, limits), "joint.limits.deceleration_rad_s2")) << i;
    limits = wide();
    limits.torque_Nm = little.torque_Nm;
    EXPECT_TRUE(names(find_defect(path, limits), "joint.limits.torque_limit_Nm")) << i;
  }
}

// Two knots at rest, 1 rad apart in 1 s: 1.5 rad/s in the middle, 6 rad/s^2 at the ends.
TEST(KnotPath, NamesKnotTimeValueAndLimit) {
  const KnotPath path = make_path({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}});
  PathLimits limits = wide();
  limits.motion.velocity_rad_s = 1.4;
  const auto speed = find_defect(path, limits);
  ASSERT_TRUE(speed);
  EXPECT_EQ(
      speed,
      "knot 1 (at 1.5 s): speed in rad/s = 1.5: at most 1.4 is allowed (joint.limits.speed_limit_rad_s)");
  limits = wide();
  limits.range.max_rad = 0.9;
  EXPECT_EQ(find_defect(path, limits),
            "knot 2 (at 2 s): position_rad = 1: at most 0.9 is allowed (joint.limits.position_max_rad)");
  limits = wide();
  limits.torque_Nm = 2.9;
  EXPECT_EQ(find_defect(path, limits),
            "knot 1 (at 1 s): torque of the inertia alone in N.m = 3: at most 2.9 is allowed "
            "(joint.limits.torque_limit_Nm)");
}

TEST(KnotPath, NamesANumberThatIsNone) {
  const KnotPath path = make_path({{0, 0, 0}, {1, 1, std::nan("")}});
  EXPECT_EQ(find_defect(path, wide()), "knot 1 (at 1 s): velocity_rad_s = nan: a finite number is allowed");
}

// A position of 45, given in degrees by mistake, also exceeds the torque limit. The range explains the mistake better.
TEST(KnotPath, NamesAPlaceOutOfRangeBeforeWhatTheWayThereWouldTake) {
  PathLimits limits = wide();
  limits.torque_Nm = 2.9;
  limits.range.max_rad = 3.2;
  const KnotPath path = make_path({{0, 0, 0}, {1, 45, 0}});
  EXPECT_EQ(find_defect(path, limits),
            "knot 1 (at 1 s): position_rad = 45: at most 3.2 is allowed (joint.limits.position_max_rad)");
}

// Cubics represent a trapezoidal speed profile exactly, so a path may use its limits to the last bit.
TEST(KnotPath, MayUseItsLimitsWhole) {
  const PathLimits limits{{0.0, 3.0}, {2.0, 4.0, 8.0}, 4.0, 0.5, 1e-3};
  const KnotPath path = make_path({{0, 0, 0}, {0.5, 0.5, 2}, {1.625, 2.75, 2}, {1.875, 3, 0}});
  EXPECT_EQ(find_defect(path, limits), std::nullopt);
}

TEST(KnotPath, HasTwoTo320Knots) {
  std::vector<PathKnot> knots;
  for (std::size_t i = 0; i < KnotPath::kMostKnots; ++i)
    knots.push_back({0.01 * static_cast<double>(i), 0.5, 0});
  EXPECT_EQ(find_defect(make_path(knots), wide()), std::nullopt);
  knots.push_back({4.0, 0.5, 0.0});
  const auto many = find_defect(make_path(knots), wide());
  ASSERT_TRUE(many);
  EXPECT_EQ(*many, "knot_count = 321: from 2 to 320 are allowed");
  EXPECT_EQ(find_defect(make_path({{0, 0, 0}}), wide()), "knot_count = 1: from 2 to 320 are allowed");
  EXPECT_EQ(find_defect(KnotPath{}, wide()), "knot_count = 0: from 2 to 320 are allowed");
}

TEST(KnotPath, IsRefusedWhenItsNumbersAreNoPath) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto is_refused = [](const std::vector<PathKnot>& knots, const std::string& what) {
    return names(find_defect(make_path(knots), wide()), what);
  };
  EXPECT_TRUE(is_refused({{0, 0, 0}, {1, nan, 0}}, "a finite number is allowed"));
  EXPECT_TRUE(is_refused({{0, 0, 0}, {nan, 0, 0}}, "a finite number is allowed"));
  EXPECT_TRUE(is_refused({{0, 0, 0}, {0.5, 0, std::numeric_limits<double>::infinity()}, {1, 0, 0}},
                         "a finite number is allowed"));
  EXPECT_TRUE(is_refused({{0.1, 0, 0}, {1, 0, 0}}, "0 is allowed, the first knot begins the path"));
  EXPECT_TRUE(is_refused({{-0.1, 0, 0}, {1, 0, 0}}, "0 is allowed, the first knot begins the path"));
  EXPECT_TRUE(is_refused({{0, 0, 0}, {1, 0, 0}, {1.0005, 0, 0}}, "a period after the knot before"));
  EXPECT_TRUE(is_refused({{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}, "a period after the knot before"));
  EXPECT_TRUE(is_refused({{0, 0, 0}, {3601, 0, 0}}, "at most 3600 is allowed"));
  EXPECT_TRUE(is_refused({{0, 0, 0.1}, {1, 0, 0}}, "a path begins and ends at rest"));
  EXPECT_TRUE(is_refused({{0, 0, 0}, {1, 0, 0.1}}, "a path begins and ends at rest"));
  EXPECT_EQ(find_defect(make_path({{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}), wide()),
            "knot 2 (at 0.5 s): time_s = 0.5: at least 1.001 is allowed, a period after the knot before");
}

}  // namespace
}  // namespace strainwave
