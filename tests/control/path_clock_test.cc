// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/path_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr MotionLimits kLimits{2.0, 8.0, 12.0};

/// A random path, slowed down until it keeps kLimits.
KnotPath possible_path(std::mt19937& random) {
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  std::uniform_real_distribution<double> velocity(-1.0, 1.0);
  KnotPath path;
  path.count = 12;
  for (std::size_t i = 0; i < path.count; ++i) path.knots[i] = {0.0, position(random), velocity(random)};
  path.knots[0].velocity_rad_s = path.knots[path.count - 1].velocity_rad_s = 0.0;
  const PathLimits limits{{-1e6, 1e6}, kLimits, 1e9, 1.0, kPeriod_s};
  for (double interval_s = 0.2;; interval_s *= 1.05) {
    for (std::size_t i = 0; i < path.count; ++i) path.knots[i].time_s = static_cast<double>(i) * interval_s;
    if (!find_defect(path, limits)) return path;
    for (std::size_t i = 0; i < path.count; ++i) path.knots[i].velocity_rad_s *= 0.97;
  }
}

/// Joints that share one clock, as in the daemon's loop.
struct Followers {
  std::vector<KnotPath> paths;
  std::vector<PathReader> readers = std::vector<PathReader>(paths.size());
  PathClock clock{};

  std::vector<Reference> step() {
    RateRoom room = PathClock::kMostRoom;
    for (std::size_t i = 0; i < paths.size() && !clock.steady(); ++i) {
      PathReader ahead = readers[i];
      const Reference here = ahead.at(paths[i], clock.time_s());
      room = room.both(rate_room(here, ahead.at(paths[i], clock.time_s() + kPeriod_s * clock.rate()),
                                 clock.rate(), kLimits));
    }
    clock.advance(kPeriod_s, room);
    std::vector<Reference> points;
    for (std::size_t i = 0; i < paths.size(); ++i)
      points.push_back(in_path_time(readers[i].at(paths[i], clock.time_s()), clock.now()));
    return points;
  }
};

TEST(PathClock, TakesATenthOfASecondToRestWhereAccelerationsAllowMore) {
  PathClock clock{};
  clock.rest();
  int periods = 0;
  for (; clock.rate() > 0.0 && periods < 1000; ++periods) clock.advance(kPeriod_s, {1e9, 1e9});
  EXPECT_NEAR(periods, 100, 1);
  EXPECT_NEAR(clock.time_s(), 0.05, 1e-3);
  clock.run();
  for (periods = 0; !clock.steady() && periods < 1000; ++periods) clock.advance(kPeriod_s, {1e9, 1e9});
  EXPECT_NEAR(periods, 100, 1);
}

// Three joints, paused and resumed at random instants. No joint accelerates more than allowed from one period to the next, except for
// 2 %: the path's own acceleration changes within a period.
TEST(PathClock, PausesAndResumesWithinTheAccelerationsOfEveryJoint) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> periods(20, 900);
  for (int round = 0; round < 40; ++round) {
    Followers group{{possible_path(random), possible_path(random), possible_path(random)}};
    double duration_s = 0.0;
    for (const KnotPath& path : group.paths) duration_s = std::max(duration_s, path.duration_s());
    std::vector<Reference> last(3);
    int wait = periods(random);
    double most_growing = 0.0;
    double most_falling = 0.0;
    int total = 0;
    for (; group.clock.time_s() < duration_s && total < 1'000'000; ++total) {
      if (--wait == 0) {
        wait = periods(random);
        group.clock.is_to_rest() ? group.clock.run() : group.clock.rest();
      }
      const std::vector<Reference> now = group.step();
      for (std::size_t i = 0; i < now.size() && total > 0; ++i) {
        const double change =
            (std::abs(now[i].velocity_rad_s) - std::abs(last[i].velocity_rad_s)) / kPeriod_s;
        most_growing = std::max(most_growing, change);
        most_falling = std::max(most_falling, -change);
      }
      last = now;
    }
    ASSERT_LT(total, 1'000'000);
    EXPECT_LE(most_growing, 1.02 * kLimits.acceleration_rad_s2) << round;
    EXPECT_LE(most_falling, 1.02 * kLimits.deceleration_rad_s2) << round;
  }
}

// From every instant the clock comes to rest within half a second, or the path ends before.
TEST(PathClock, ComesToRestFromEveryInstantOfAPath) {
  std::mt19937 random(7);
  double longest_s = 0.0;
  for (int round = 0; round < 10; ++round) {
    const KnotPath path = possible_path(random);
    for (double from_s = 0.0; from_s < path.duration_s(); from_s += 0.05) {
      Followers one{{path}};
      while (one.clock.time_s() < from_s) one.step();
      one.clock.rest();
      int periods = 0;
      for (; one.clock.rate() > 0.0 && one.clock.time_s() < path.duration_s(); ++periods) one.step();
      longest_s = std::max(longest_s, periods * kPeriod_s);
    }
  }
  // A joint alone stops from full speed in 2 / 12 s.
  EXPECT_LE(longest_s, 0.5);
}

TEST(PathClock, LeavesTheVelocityOfAPathThatRunsAsItIs) {
  PathClock clock{};
  const Reference point{0.3, 1.5, -4.0};
  const Reference same = in_path_time(point, clock.now());
  EXPECT_EQ(same.velocity_rad_s, point.velocity_rad_s);
  EXPECT_EQ(same.acceleration_rad_s2, point.acceleration_rad_s2);
  clock.rest();
  clock.advance(kPeriod_s, PathClock::kMostRoom);
  EXPECT_NEAR(in_path_time(point, clock.now()).velocity_rad_s, 0.99 * 1.5, 1e-9);
  EXPECT_NEAR(in_path_time(point, clock.now()).acceleration_rad_s2, -0.99 * 0.99 * 4.0 - 10.0 * 1.5, 1e-6);
}

TEST(PathTimes, TellWhereTheTimeWasAndThatThePathHadNotBegun) {
  PathClock clock;
  PathTimes times;
  for (int k = 0; k < 300; ++k) {  // more than it keeps
    clock.advance(1e-3, PathClock::kMostRoom);
    times.note(clock.now());
  }
  EXPECT_EQ(times.ago(0.0).time_s, clock.time_s());
  EXPECT_NEAR(times.ago(7.25).time_s, clock.time_s() - 7.25e-3, 1e-12);
  EXPECT_NEAR(times.ago(7.25).rate, 1.0, 1e-12);
  EXPECT_NEAR(times.ago(1e9).time_s, clock.time_s() - 1e-3 * static_cast<double>(PathTimes::kPeriods - 1),
              1e-12);
  PathTimes young;
  young.note({1e-3, 1.0, 0.0});
  EXPECT_EQ(young.ago(1.5).time_s, 0.0);
  EXPECT_EQ(young.ago(1.5).rate, 0.0);
}

}  // namespace
}  // namespace strainwave
