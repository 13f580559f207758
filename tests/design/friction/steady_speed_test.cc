// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/steady_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace strainwave {
namespace {

constexpr double kInertia_kgm2 = 0.089;
constexpr double kStep_s = 0.005;

/// A recording that is built leg by leg.
class Recording {
 public:
  using Torque = std::function<double(double position_rad, double velocity_rad_s)>;
  explicit Recording(Torque torque) : torque_(std::move(torque)) {}

  /// Moves the setpoint to `target_rad` at a constant speed. `factor` scales the joint's true speed over time.
  void leg(
      double target_rad, double speed_rad_s,
      const std::function<double(double)>& factor = [](double) { return 1.0; }) {
    const double direction = target_rad > position_rad_ ? 1.0 : -1.0;
    const double velocity = direction * speed_rad_s;
    for (double t = 0.0; direction * (target_rad - position_rad_) > 0.0; t += kStep_s) {
      add(velocity, torque_(position_rad_, velocity), velocity * factor(t));
      position_rad_ += velocity * factor(t) * kStep_s;
    }
    add(0.0, 0.0, 0.0);
    add(0.0, 0.0, 0.0);
  }
  void add(double setpoint_velocity_rad_s, double torque_Nm, double velocity_rad_s) {
    samples.push_back(
        {time_s_, true, setpoint_velocity_rad_s, position_rad_, velocity_rad_s, torque_Nm, temperature_C});
    time_s_ += kStep_s;
  }
  SteadyPoints points() const { return find_steady_points(samples, kInertia_kgm2); }

  std::vector<MotionSample> samples;
  double temperature_C = 20.0;

 private:
  Torque torque_;
  double position_rad_ = 0.0;
  double time_s_ = 0.0;
};

double friction(double velocity) {
  return std::copysign(2.0 + 0.5 * std::abs(velocity), velocity);
}

TEST(SteadySpeed, FindsTheFrictionOfEverySpeed) {
  Recording recording([](double, double v) { return friction(v); });
  for (const double speed : {0.05, 0.2, 1.0}) {
    recording.leg(speed, speed);
    recording.leg(0.0, speed);
  }
  const SteadyPoints found = recording.points();
  ASSERT_EQ(found.points.size(), 3U);
  for (const SteadyPoint& point : found.points) {
    EXPECT_NEAR(point.friction_Nm, 2.0 + 0.5 * point.speed_rad_s, 1e-9);
    EXPECT_NEAR(point.load_Nm, 0.0, 1e-9);
    EXPECT_EQ(point.temperature_C, 20.0);
  }
  EXPECT_EQ(found.not_steady + found.too_short + found.without_return, 0);
}

TEST(SteadySpeed, IsNotMisledByALoadThatDependsOnThePosition) {
  Recording recording([](double x, double v) { return friction(v) + 3.0 + 1.5 * std::sin(2.0 * x); });
  recording.leg(1.0, 0.5);
  recording.leg(0.0, 0.5);
  const SteadyPoints found = recording.points();
  ASSERT_EQ(found.points.size(), 1U);
  EXPECT_NEAR(found.points[0].friction_Nm, 2.25, 0.01);
  EXPECT_GT(found.points[0].load_Nm, 3.0);
}

TEST(SteadySpeed, LeavesOutTheTransientAtTheBeginningOfARun) {
  double time_in_leg = 0.0;
  Recording recording([&](double, double v) {
    time_in_leg += kStep_s;
    return friction(v) + (time_in_leg < 0.15 ? std::copysign(5.0, v) : 0.0);
  });
  recording.leg(0.5, 0.5);
  time_in_leg = 0.0;
  recording.leg(0.0, 0.5);
  ASSERT_EQ(recording.points().points.size(), 1U);
  EXPECT_NEAR(recording.points().points[0].friction_Nm, 2.25, 1e-9);
}

TEST(SteadySpeed, RejectsAJointThatSticksAndSlips) {
  Recording recording([](double, double v) { return friction(v); });
  const auto stick_slip = [](double t) { return std::fmod(t, 0.4) < 0.2 ? 0.0 : 2.0; };
  recording.leg(0.1, 0.05, stick_slip);
  recording.leg(0.0, 0.05, stick_slip);
  EXPECT_TRUE(recording.points().points.empty());
  EXPECT_EQ(recording.points().not_steady, 2);
}

TEST(SteadySpeed, RejectsASpeedThatRipplesTooFastToShowInThePosition) {
  Recording recording([](double, double v) { return friction(v); });
  const auto ripple = [](double t) { return std::llround(t / kStep_s) % 2 == 0 ? 0.5 : 1.5; };
  recording.leg(0.5, 0.5, ripple);
  recording.leg(0.0, 0.5, ripple);
  EXPECT_EQ(recording.points().not_steady, 2);
}

TEST(SteadySpeed, RejectsAJointThatStillAccelerates) {
  // The torque is small and the speed rises by a few per cent, so that inertia takes much of the torque.
  Recording recording([](double, double v) { return std::copysign(0.05, v); });
  const auto rising = [](double t) { return 0.99 + 0.02 * t; };
  recording.leg(3.0, 3.0, rising);
  recording.leg(0.0, 3.0, rising);
  EXPECT_TRUE(recording.points().points.empty());
  EXPECT_EQ(recording.points().not_steady, 2);
}

TEST(SteadySpeed, WantsTheWayBackOverTheSameStretch) {
  Recording recording([](double, double v) { return friction(v); });
  recording.leg(0.5, 0.5);
  recording.leg(0.0, 0.25);
  EXPECT_TRUE(recording.points().points.empty());
  EXPECT_EQ(recording.points().without_return, 2);
}

TEST(SteadySpeed, DoesNotUseARunWithoutATemperatureOrWithTooFewSamples) {
  Recording recording([](double, double v) { return friction(v); });
  recording.temperature_C = std::nan("");
  recording.leg(0.5, 0.5);
  recording.temperature_C = 20.0;
  recording.leg(0.48, 0.5);
  EXPECT_TRUE(recording.points().points.empty());
  EXPECT_EQ(recording.points().no_temperature, 1);
  EXPECT_EQ(recording.points().too_short, 1);
}

TEST(SteadySpeed, SplitsARunWhereMessagesWereLost) {
  Recording recording([](double, double v) { return friction(v); });
  recording.leg(1.0, 0.5);
  recording.samples.erase(recording.samples.begin() + 195, recording.samples.begin() + 230);
  recording.leg(0.0, 0.5);
  const SteadyPoints found = recording.points();
  EXPECT_EQ(found.points.size() * 2 + static_cast<std::size_t>(found.without_return), 3U);
}

}  // namespace
}  // namespace strainwave
