// SPDX-License-Identifier: BSD-3-Clause
// Streams that exceed the joint's limits, through the whole loop on the simulated joint. The joint follows them as closely as the limits allow, and a
// notice says so. There is no fault, no limit is exceeded, the torque does not oscillate, and the joint rests after the stream. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "sim/joint/reference_plant.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kStep_s = 1e-3;
constexpr int kStreamed = 4000;  ///< periods
constexpr int kAfterwards = 2000;
constexpr int kResting = 1500;  ///< periods after the stream, then it must rest

struct Place {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
};

/// The streamed motion over time.
struct Shape {
  std::string name;
  Place (*at)(double t_s);
};

Place sine(double t_s, double amplitude_rad, double rate_Hz) {
  const double omega = 2.0 * std::numbers::pi * rate_Hz;
  return {amplitude_rad * std::sin(omega * t_s), amplitude_rad * omega * std::cos(omega * t_s)};
}

Place square(double t_s, double amplitude_rad, double rate_Hz) {
  return {std::fmod(t_s * rate_Hz, 1.0) < 0.5 ? amplitude_rad : -amplitude_rad, 0.0};
}

Place sawtooth(double t_s, double amplitude_rad, double rate_Hz) {
  return {amplitude_rad * (2.0 * std::fmod(t_s * rate_Hz, 1.0) - 1.0), 2.0 * amplitude_rad * rate_Hz};
}

/// A random value between -1 and 1, the same for the same time.
double drawn(double t_s, double per_s) {
  std::mt19937 random(static_cast<unsigned>(std::floor(t_s * per_s + 1e-6)) * 7919U + 1U);
  random.discard(3);
  return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
}

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {"sine of 1 rad, 3 Hz", [](double t) { return sine(t, 1.0, 3.0); }},
      {"sine of 2 rad, 0.7 Hz", [](double t) { return sine(t, 2.0, 0.7); }},
      {"sine of 0.3 rad, 8 Hz", [](double t) { return sine(t, 0.3, 8.0); }},
      {"square wave of 1 rad, 1 Hz", [](double t) { return square(t, 1.0, 1.0); }},
      {"sawtooth of 1 rad, 1.5 Hz", [](double t) { return sawtooth(t, 1.0, 1.5); }},
      {"steps to anywhere in 3 rad",
       [](double t) {
         return Place{2.9 * drawn(t, 2.0), 0.0};
       }},
      {"noise of 1 rad",
       [](double t) {
         return Place{drawn(t, 1000.0), 0.0};
       }},
  };
  return all;
}

struct Joint {
  bool told = false;         ///< on a spring that the controller knows
  double jerk_rad_s3 = 0.0;  ///< limit; 0: none
};

BenchJoint bench_joint(const Joint& kind) {
  BenchJoint joint = demo_joint();
  JointControllerConfig& controller = joint.loop.controller;
  if (kind.jerk_rad_s3 > 0.0) {
    controller.jerk_limit_rad_s3 = kind.jerk_rad_s3;
    controller.motion.acceleration_rad_s2 = 40.0;
    controller.motion.deceleration_rad_s2 = 40.0;
  }
  if (kind.told) put_on_spring(joint, flexible_plant());
  return joint;
}

struct Outcome {
  Fault fault = Fault::kNone;
  int faulted_at = 0;
  bool off_stream = false;
  double fastest_rad_s = 0.0;  ///< of the setpoint
  double hardest_rad_s2 = 0.0;
  double jerk_rad_s3 = 0.0;
  double farthest_rad = 0.0;
  double rest_rad_s = 0.0;  ///< the link's fastest, after the stream and the time to stop
};

/// A sample every `every` periods; 0: the interval changes every half second.
Outcome ride(const Joint& kind, const Shape& shape, int every, bool with_velocity) {
  constexpr int kIntervals[] = {10, 2, 50, 5, 20, 1, 33, 3};
  const BenchJoint joint = bench_joint(kind);
  JointBench bench({joint});
  bench.bring_to_hold(0, kind.told ? flexible_table() : demo_table());
  Outcome outcome;
  double last_rad_s = 0.0, last_rad_s2 = 0.0;
  int next = 0;
  for (int k = 0; k < kStreamed + kAfterwards && outcome.fault == Fault::kNone; ++k) {
    if (k == next && k < kStreamed) {
      next += every > 0 ? every : kIntervals[k / 500 % 8];
      const Place place = shape.at(k * kStep_s);
      Order order;
      order.kind = OrderKind::kSetpoint;
      order.stream_id = 1;
      order.begins_stream = order.approaches = k == 0;
      order.sent_us = bench.sent_us();
      order.valid_for_s = 0.2;
      order.position_rad = place.position_rad;
      order.derivatives = with_velocity ? 1 : 0;
      order.velocity_rad_s = with_velocity ? place.velocity_rad_s : 0.0;
      EXPECT_TRUE(bench.joint(0).orders().push(order));
    }
    bench.step();
    const state_v1& state = bench.state(0);
    outcome.fault = bench.fault(0);
    outcome.faulted_at = k;
    outcome.off_stream = outcome.off_stream || bench.has_notice(0, Notice::kOffStream);
    outcome.fastest_rad_s = std::max(outcome.fastest_rad_s, std::abs(state.setpoint_velocity_rad_s));
    outcome.farthest_rad = std::max(outcome.farthest_rad, std::abs(state.setpoint_position_rad));
    const double rad_s2 = (state.setpoint_velocity_rad_s - last_rad_s) / kStep_s;
    if (k > 0) outcome.hardest_rad_s2 = std::max(outcome.hardest_rad_s2, std::abs(rad_s2));
    if (k > 1) outcome.jerk_rad_s3 = std::max(outcome.jerk_rad_s3, std::abs(rad_s2 - last_rad_s2) / kStep_s);
    last_rad_s = state.setpoint_velocity_rad_s;
    last_rad_s2 = rad_s2;
    if (k >= kStreamed + kResting) {
      const double link_rad_s = bench.drive(0).simulated().plant().link_state().velocity_rad_s;
      outcome.rest_rad_s = std::max(outcome.rest_rad_s, std::abs(link_rad_s));
    }
  }
  return outcome;
}

constexpr int kEvery[] = {50, 10, 2, 0};

::testing::Message what(const Shape& shape, int every, bool with_velocity) {
  return ::testing::Message() << shape.name << ", every " << every
                              << (with_velocity ? ", with velocity" : "");
}

void expect_calm(const Outcome& outcome, const ::testing::Message& what) {
  EXPECT_EQ(outcome.fault, Fault::kNone) << what << ", at " << outcome.faulted_at;
  EXPECT_TRUE(outcome.off_stream) << what;
  EXPECT_LT(outcome.rest_rad_s, 1e-3) << what;
}

TEST(InfeasibleStreams, AreFollowedByARigidJointWithinItsLimitsAndSayTheyAreOff) {
  for (const double jerk_rad_s3 : {0.0, 2000.0}) {
    const Joint kind{.jerk_rad_s3 = jerk_rad_s3};
    const MotionLimits limits = bench_joint(kind).loop.controller.motion;
    for (const Shape& shape : shapes())
      for (const int every : kEvery)
        for (const bool with_velocity : {false, true}) {
          const Outcome outcome = ride(kind, shape, every, with_velocity);
          const ::testing::Message message = what(shape, every, with_velocity);
          expect_calm(outcome, message);
          EXPECT_LE(outcome.fastest_rad_s, limits.velocity_rad_s + 1e-9) << message;
          EXPECT_LE(outcome.farthest_rad, 3.2) << message;
          EXPECT_LE(outcome.hardest_rad_s2, limits.acceleration_rad_s2 + 1e-6) << message;
          if (jerk_rad_s3 > 0.0) {
            EXPECT_LT(outcome.jerk_rad_s3, 1.001 * jerk_rad_s3) << message;
          }
        }
  }
}

// The setpoint there is the motor's, which leads the link by the wind-up. It is faster than the link's limit
// by Jl 2 A / (tau K), 1 rad/s for all of the acceleration from one limit to the other (docs/streams.md).
TEST(InfeasibleStreams, AreFollowedByAJointThatIsToldOfItsSpring) {
  int rides = 0;
  for (const Shape& shape : shapes())
    for (const int every : kEvery) {
      const bool with_velocity = rides++ % 3 != 0;
      const Outcome outcome = ride({.told = true}, shape, every, with_velocity);
      const ::testing::Message message = what(shape, every, with_velocity);
      expect_calm(outcome, message);
      EXPECT_LE(outcome.fastest_rad_s, 7.1) << message;
      EXPECT_LE(outcome.farthest_rad, 3.21) << message;
    }
}

}  // namespace
}  // namespace strainwave::testing
