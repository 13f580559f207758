// SPDX-License-Identifier: BSD-3-Clause
// How soon a joint at rest is on a stream that it joins in mid-motion: the followed reference against the shortest time in which its limits
// let it be where the sine is, as fast as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/trajectory/reference_shaper.h"
#include "control/trajectory/stream_buffer.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr std::int64_t kAhead = 20;  ///< periods that samples are stamped ahead
constexpr double kOn_rad = 5e-3;
constexpr int kPeriods = 5000;
constexpr int kSettled = 4000;  ///< by then everyone is on it

struct Sine {
  double amplitude_rad = 0.0;
  double omega_rad_s = 0.0;
  double phase = 0.0;
  double centre_rad = 0.0;
  double position_rad(double t_s) const {
    return centre_rad + amplitude_rad * std::sin(omega_rad_s * t_s + phase);
  }
  double velocity_rad_s(double t_s) const {
    return amplitude_rad * omega_rad_s * std::cos(omega_rad_s * t_s + phase);
  }
};

struct Join {
  Sine sine;
  double acceleration_rad_s2 = 0.0;
  double velocity_rad_s = 0.0;
  int every = 10;  ///< periods
  bool with_velocity = false;
};

// From rest at 0, faster and slower again until `end_rad_s` after `duration_s`; all within the limits.
double farthest_rad(double duration_s, double end_rad_s, double acceleration_rad_s2, double fastest_rad_s) {
  const double A = acceleration_rad_s2;
  const double top_rad_s = std::min(fastest_rad_s, 0.5 * (A * duration_s + end_rad_s));
  const double cruising_s = duration_s - (2.0 * top_rad_s - end_rad_s) / A;
  return (2.0 * top_rad_s * top_rad_s - end_rad_s * end_rad_s) / (2.0 * A) + top_rad_s * cruising_s;
}

// With a given duration and end velocity every place between the farthest either way can be had.
double shortest_s(const Join& join) {
  for (double duration_s = 0.0;; duration_s += kPeriod_s) {
    const double end_rad = join.sine.position_rad(duration_s);
    const double end_rad_s = join.sine.velocity_rad_s(duration_s);
    const auto farthest = [&](double rad_s) {
      return farthest_rad(duration_s, rad_s, join.acceleration_rad_s2, join.velocity_rad_s);
    };
    if (std::abs(end_rad_s) > join.acceleration_rad_s2 * duration_s) continue;
    if (end_rad <= farthest(end_rad_s) && -end_rad <= farthest(-end_rad_s)) return duration_s;
  }
}

// Until the reference is within kOn_rad of the sine for good. Its limits hold all the while, and once it is on the target nothing is left but the
// target's own acceleration.
double time_to_be_on_s(const Join& join) {
  StreamBuffer target({.period_s = kPeriod_s});
  ReferenceShaper shaper(kPeriod_s);
  shaper.set_limits({join.velocity_rad_s, join.acceleration_rad_s2, join.acceleration_rad_s2});
  target.begin(0.0, 0.0, 0.0, {});
  double on_s = 0.0;
  double fastest_rad_s = 0.0;
  double hardest_rad_s2 = 0.0;
  double unasked_rad_s2 = 0.0;
  for (int k = 0; k < kPeriods; ++k) {
    const double t_s = k * kPeriod_s;
    if (k % join.every == 0)
      target.take({join.sine.position_rad(t_s + kAhead * kPeriod_s),
                   join.with_velocity ? join.sine.velocity_rad_s(t_s + kAhead * kPeriod_s) : 0.0, 0.0,
                   join.with_velocity ? 1 : 0, kAhead},
                  {join.velocity_rad_s, join.acceleration_rad_s2, join.acceleration_rad_s2});
    const MovingTarget now = target.step();
    const Reference reference = shaper.follow(now, PositionRange{});
    hardest_rad_s2 = std::max(hardest_rad_s2, std::abs(reference.acceleration_rad_s2));
    fastest_rad_s = std::max(fastest_rad_s, std::abs(shaper.velocity_rad_s()));
    const double end_s = t_s + kPeriod_s;
    if (std::abs(shaper.position_rad() - join.sine.position_rad(end_s)) > kOn_rad) on_s = t_s + kPeriod_s;
    const double own_rad_s2 = (now.next_velocity_rad_s - now.velocity_rad_s) / kPeriod_s;
    if (k > kSettled)
      unasked_rad_s2 = std::max(unasked_rad_s2, std::abs(reference.acceleration_rad_s2 - own_rad_s2));
  }
  EXPECT_LE(fastest_rad_s, join.velocity_rad_s * (1.0 + 1e-9));
  EXPECT_LE(hardest_rad_s2, join.acceleration_rad_s2 * (1.0 + 1e-9));
  EXPECT_LT(unasked_rad_s2, 0.02 * join.acceleration_rad_s2) << "chatter about the target";
  return on_s;
}

struct Joins {
  int count = 0;
  int slow = 0;  ///< half as long again as the shortest time, and 0.1 s, or longer
  double mean_ratio = 0.0;
  double most_s = 0.0;  ///< beyond the shortest time
};

// Of sines that take this share of the joint's speed or acceleration, whichever they reach first, from everywhere in and about them.
Joins joins(double share) {
  Joins all;
  for (const double acceleration_rad_s2 : {30.0, 150.0})
    for (const double velocity_rad_s : {4.0, 6.0})
      for (const double rate_Hz : {0.25, 0.5, 1.0, 2.0})
        for (int eighth = 0; eighth < 6; ++eighth)
          for (const double centre_rad : {0.0, -0.5, 0.5, -2.0, 2.0})
            for (const bool with_velocity : {false, true}) {
              const double omega_rad_s = 2.0 * std::numbers::pi * rate_Hz;
              const double amplitude_rad =
                  std::min({2.0, share * acceleration_rad_s2 / (omega_rad_s * omega_rad_s),
                            share * velocity_rad_s / omega_rad_s});
              const Join join{{amplitude_rad, omega_rad_s, 0.25 * std::numbers::pi * eighth, centre_rad},
                              acceleration_rad_s2,
                              velocity_rad_s,
                              with_velocity ? 2 : 10,
                              with_velocity};
              const double least_s = shortest_s(join);
              const double took_s = time_to_be_on_s(join);
              ++all.count;
              all.slow += took_s > 1.5 * least_s + 0.1 ? 1 : 0;
              all.mean_ratio += took_s / std::max(least_s, 0.05);
              all.most_s = std::max(all.most_s, took_s - least_s);
            }
  all.mean_ratio /= all.count;
  return all;
}

TEST(StreamJoin, TakesLittleMoreThanTheShortestTimeWhereTheStreamLeavesSomeOfTheLimits) {
  for (const double share : {0.3, 0.6}) {
    const Joins all = joins(share);
    EXPECT_LT(all.mean_ratio, 1.1) << share;
    EXPECT_EQ(all.slow, 0) << share;
    EXPECT_LT(all.most_s, 0.35) << share;
  }
}

TEST(StreamJoin, IsOverSoonWhereTheStreamLeavesATenthOfTheLimits) {
  const Joins all = joins(0.9);
  EXPECT_LT(all.mean_ratio, 1.2);
  EXPECT_LT(all.slow, all.count / 40);
  EXPECT_LT(all.most_s, 1.1);
}

}  // namespace
}  // namespace strainwave
