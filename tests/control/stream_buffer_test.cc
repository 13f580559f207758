// SPDX-License-Identifier: BSD-3-Clause
// The motion that StreamBuffer generates from samples. Effects of the network are in stream_buffer_network_test.cc.
#include "control/trajectory/stream_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "control/trajectory/reference_shaper.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr MotionLimits kReach{6.0, 150.0, 150.0};
constexpr double kOmega_rad_s = std::numbers::pi;
constexpr double kCount_rad = 24e-6;
constexpr StreamConfig kConfig{kPeriod_s, 0.05, 0.03, kCount_rad};
constexpr std::int64_t kEpoch_us = 1'700'000'000'000'000;

StreamSample sine(double t_s, int derivatives) {
  const double phase = kOmega_rad_s * t_s;
  return {0.5 * std::sin(phase), 0.5 * kOmega_rad_s * std::cos(phase),
          -0.5 * kOmega_rad_s * kOmega_rad_s * std::sin(phase), derivatives};
}

/// `sample` for the period that is `ahead` periods from now.
StreamSample stamped(StreamSample sample, std::int64_t ahead) {
  sample.in_periods = ahead;
  return sample;
}

StreamSample sent(StreamSample sample, int period) {
  sample.sent_us = kEpoch_us + 1000 * period;
  return sample;
}

StreamBuffer begun(double position_rad = 0.0, double velocity_rad_s = 0.0, double lead_periods = 0.0) {
  StreamBuffer buffer(kConfig);
  buffer.begin(position_rad, velocity_rad_s, lead_periods, {});
  return buffer;
}

TEST(StreamBuffer, IsAheadOfItsSamplesByItsLead) {
  constexpr int kLead = 7;
  StreamBuffer buffer = begun(0.0, 0.0, kLead);
  for (int k = 0; k < 2000; ++k) {
    if (k % 10 == 0) buffer.take(stamped(sine(kPeriod_s * k + 0.03, 1), 30), kReach);
    const double position_rad = buffer.step().position_rad;
    if (k > 500) {
      EXPECT_NEAR(position_rad, sine(kPeriod_s * (k + kLead), 0).position_rad, 1e-4);
    }
  }
}

TEST(StreamBuffer, CountsAsLateWhatComesAfterItsInstant) {
  StreamBuffer buffer = begun(0.0, 0.0, 5.0);
  EXPECT_EQ(buffer.take(stamped({0.01}, 20), kReach), SampleFate::kInTime);
  for (int k = 0; k < 10; ++k) buffer.step();
  EXPECT_EQ(buffer.take(stamped({0.02}, 4), kReach), SampleFate::kLate) << "the target is 5 periods ahead";
  EXPECT_EQ(buffer.take(stamped({0.02}, 6), kReach), SampleFate::kInTime);
}

TEST(StreamBuffer, NeverEndsWhereItStandsStill) {
  StreamBuffer buffer = begun(0.3);
  for (int k = 0; k < 100; k += 10) buffer.take(stamped({0.3}, 20), kReach);
  for (int k = 0; k < 5000; ++k) EXPECT_EQ(buffer.step().position_rad, 0.3);
  EXPECT_FALSE(buffer.ended());
}

TEST(StreamBuffer, ComesToRestExactlyWhereSamplesSayItAgainAndAgain) {
  for (const int derivatives : {0, 1}) {
    StreamBuffer buffer = begun();
    MovingTarget target;
    for (int k = 0; k < 1500; ++k) {
      const double t_s = std::min(1.0, kPeriod_s * (k + 20));
      const double rate_rad_s = t_s < 1.0 ? 0.5 : 0.0;
      if (k % 10 == 0) buffer.take(stamped({0.5 * t_s, rate_rad_s, 0.0, derivatives}, 20), kReach);
      target = buffer.step();
    }
    EXPECT_EQ(target.position_rad, 0.5);
    EXPECT_TRUE(target.rests());
  }
}

TEST(StreamBuffer, IsNeverFarBeyondTheStepsOfAPositionStream) {
  StreamBuffer buffer = begun();
  ReferenceShaper shaper(kPeriod_s);
  shaper.set_limits(kReach);
  double highest_rad = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double step_rad = (k / 500) % 2 == 0 ? 0.0 : 1.0;
    if (k % 10 == 0) buffer.take(stamped({step_rad}, 20), kReach);
    shaper.follow(buffer.step(), {});
    highest_rad = std::max({highest_rad, shaper.position_rad() - 1.0, -shaper.position_rad()});
    if (k % 500 == 499) {
      EXPECT_EQ(shaper.position_rad(), step_rad) << k;
    }
  }
  EXPECT_LT(highest_rad, 1e-3);
}

TEST(StreamBuffer, TheNewestSampleTakesThePlaceOfThoseForLater) {
  StreamBuffer buffer = begun();
  buffer.take(stamped({0.0}, 10), kReach);
  buffer.take(stamped({1.0}, 500), kReach);
  buffer.take(stamped({0.0}, 40), kReach);
  for (int k = 0; k < 1000; ++k) EXPECT_NEAR(buffer.step().position_rad, 0.0, 1e-12);
}

TEST(StreamBuffer, LeadsTheLoadAlongALineFromSampleToSample) {
  StreamBuffer buffer = begun();
  StreamSample loaded = stamped({0.0}, 40);
  loaded.load = {8.0, 0.2};
  buffer.take(loaded, kReach);
  StreamLoad before;
  for (int k = 0; k < 40; ++k) {
    const StreamLoad now = buffer.step().load;
    EXPECT_NEAR(now.torque_Nm - before.torque_Nm, 0.2, 1e-9);
    before = now;
  }
  EXPECT_NEAR(buffer.step().load.torque_Nm, 8.0, 1e-9);
  EXPECT_NEAR(buffer.step().load.inertia_kgm2, 0.2, 1e-9);
}

// Number of samples, at 100 Hz and with velocities from `velocity_of`, until they contradict the positions. 0: they never do.
template <typename Velocity>
int samples_until_contradiction(const Velocity& velocity_of, double lost = 0.0) {
  std::mt19937 random(7);
  StreamBuffer buffer = begun();
  for (int k = 0; k < 4000; ++k) {
    if (k % 10 == 0 && std::generate_canonical<double, 32>(random) >= lost) {
      StreamSample sample = stamped(sine(kPeriod_s * (k + 20), 1), 20);
      sample.position_rad = kCount_rad * std::round(sample.position_rad / kCount_rad);
      sample.velocity_rad_s = velocity_of(sample.velocity_rad_s);
      if (buffer.take(sample, kReach) == SampleFate::kVelocitiesContradict) return k / 10 + 1;
    }
    buffer.step();
  }
  return 0;
}

TEST(StreamBuffer, UsesNoDerivativesThatAreNotAnnounced) {
  StreamBuffer buffer = begun();
  for (int k = 0; k < 1000; ++k) {
    if (k % 10 == 0) buffer.take(stamped({0.0, 4.0, 50.0, 0}, 20), kReach);
    EXPECT_EQ(buffer.step().position_rad, 0.0);
  }
}

// The sender stalls and then sends all missed samples at once, each stamped with its time of sending.
TEST(StreamBuffer, GoesOnWhereASenderStallsAndCatchesUp) {
  for (const int every : {2, 10, 20, 50})
    for (const int stall : {20, 60, 150, 300}) {
      StreamBuffer buffer = begun();
      int due = 0;
      for (int k = 0; k < 2000; ++k) {
        const bool stalls = k >= 900 && k < 900 + stall;
        for (; !stalls && due <= k; due += every) {
          StreamSample sample = sent(sine(kPeriod_s * due, 1), k);
          sample.sent_us += due % 100;  // one after the other
          if (buffer.ended()) buffer.resume(0.0, 0.0, {});
          EXPECT_NE(buffer.take(sample, kReach), SampleFate::kVelocitiesContradict) << every << ", " << stall;
        }
        buffer.step();
      }
    }
}

TEST(StreamBuffer, FollowsThePositionsUntilContradictingVelocitiesEndIt) {
  for (const int every : {5, 10, 20, 50})
    for (const double wrong : {180.0 / std::numbers::pi, -1.0, 0.0, 0.5}) {
      StreamBuffer buffer = begun(0.0, 0.5 * kOmega_rad_s);
      double fastest_rad_s = 0.0;
      SampleFate fate = SampleFate::kInTime;
      for (int k = 0; k < 500 && fate != SampleFate::kVelocitiesContradict; ++k) {
        if (k % every == 0) {
          StreamSample sample = stamped(sine(kPeriod_s * (k + 60), 1), 60);
          if (k >= 100) sample.velocity_rad_s *= wrong;
          fate = buffer.take(sample, kReach);
        }
        fastest_rad_s = std::max(fastest_rad_s, std::abs(buffer.step().next_velocity_rad_s));
      }
      EXPECT_EQ(fate, SampleFate::kVelocitiesContradict) << every << ", " << wrong;
      EXPECT_LT(fastest_rad_s, 1.5 * 0.5 * kOmega_rad_s) << every << ", " << wrong;
    }
}

TEST(StreamBuffer, GoesOnWhereVelocitiesAreALittleOff) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  EXPECT_EQ(samples_until_contradiction([](double v) { return v; }, 0.3), 0);
  EXPECT_EQ(samples_until_contradiction([](double v) { return 0.8 * v; }), 0);
  EXPECT_EQ(samples_until_contradiction([&](double v) { return v + noise(random); }), 0);
}

// Samples of position alone jump, at rest and in motion. The buffer must not extrapolate a velocity from the samples around the jump.
TEST(StreamBuffer, GoesToANewPlaceAsFastAsTheLimitsAllow) {
  for (const auto& [every, rate_rad_s] :
       {std::pair{2, 0.0}, std::pair{10, 0.0}, std::pair{20, 0.0}, std::pair{2, 0.5}, std::pair{10, 0.5}})
    for (const double step_rad : {0.1, 1.0}) {
      const auto place_rad = [&, rate = rate_rad_s](int period) {
        return (period >= 500 ? step_rad : 0.0) + rate * kPeriod_s * period;
      };
      StreamBuffer buffer = begun();
      ReferenceShaper shaper(kPeriod_s);
      shaper.set_limits(kReach);
      double beyond_rad = 0.0;
      int arrived = 0;
      for (int k = 0; k < 1000; ++k) {
        if (k % every == 0) buffer.take(stamped({place_rad(k + 60)}, 60), kReach);
        shaper.follow(buffer.step(), {});
        const double off_rad = shaper.position_rad() - place_rad(k + 1);
        if (k > 500) beyond_rad = std::max(beyond_rad, off_rad);
        if (k > 500 && std::abs(off_rad) > 1e-3) arrived = k;
      }
      EXPECT_LT(beyond_rad, 0.02 * step_rad) << every << ", " << rate_rad_s << ", " << step_rad;
      EXPECT_LT(arrived - 500, step_rad < 1.0 ? 85 : 208) << every << ", " << rate_rad_s << ", " << step_rad;
    }
}

}  // namespace
}  // namespace strainwave
