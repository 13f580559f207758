// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/closed_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/input_error.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/loop_controllers.h"

namespace strainwave {
namespace {

class ConstantTorque final : public LoopController {
 public:
  explicit ConstantTorque(double torque_Nm) : torque_Nm_(torque_Nm) {}
  double torque_Nm(const LoopSample& sample) noexcept override {
    last = sample;
    return torque_Nm_;
  }
  void reset() noexcept override {}
  LoopSample last;

 private:
  double torque_Nm_;
};

ClosedLoopConfig constant_reference(const JointPlantConfig& plant, double setpoint_rad, double duration_s) {
  ClosedLoopConfig config;
  config.plant = plant;
  config.ambient = TemperatureProfile::constant(20.0);
  config.setpoint_rad = TimeProfile::constant(setpoint_rad, {"setpoint_rad"});
  config.duration_s = duration_s;
  return config;
}

TEST(ClosedLoop, CountsTheWholeErrorOfAJointThatNeverMoves) {
  ConstantTorque nothing(0.0);
  const auto result = run_closed_loop(constant_reference(ideal_plant(), 0.5, 2.0), nothing);
  EXPECT_EQ(result.trace.size(), 2000U);
  EXPECT_DOUBLE_EQ(result.statistics.pi1_rad2, 2000.0 * 0.25);
  EXPECT_DOUBLE_EQ(result.statistics.pi2, 2000.0);
  EXPECT_EQ(result.statistics.final_error_rad, 0.5);
  EXPECT_EQ(result.statistics.steady_error_rad, 0.5);
  EXPECT_EQ(result.statistics.rise_time_s, -1.0);
  EXPECT_EQ(result.statistics.settling_time_s, -1.0);
}

TEST(ClosedLoop, GivesTheControllerTheVelocityOnlyWithAnIdealEncoder) {
  ConstantTorque push(20.0);
  run_closed_loop(constant_reference(ideal_plant(), 0.5, 0.1), push);
  ASSERT_TRUE(push.last.joint_velocity_rad_s.has_value());
  EXPECT_GT(*push.last.joint_velocity_rad_s, 1.0);
  run_closed_loop(constant_reference(realistic_plant(), 0.5, 0.1), push);
  EXPECT_FALSE(push.last.joint_velocity_rad_s.has_value());
}

TEST(ClosedLoop, SaysSoWhenTheJointRunsAway) {
  ConstantTorque push(1e9);
  const auto result = run_closed_loop(constant_reference(ideal_plant(), 0.5, 100.0), push);
  EXPECT_TRUE(result.diverged);
  EXPECT_TRUE(std::isinf(result.statistics.pi2));
  EXPECT_LT(result.trace.size(), 100000U);
}

class LateSwitch final : public LoopController {
 public:
  double torque_Nm(const LoopSample& sample) noexcept override {
    time_s_ = sample.time_s;
    return 1.0;
  }
  void reset() noexcept override { time_s_ = 0.0; }
  bool switched_off() const noexcept override { return time_s_ > 0.2995; }

 private:
  double time_s_ = 0.0;
};

TEST(ClosedLoop, RemembersWhenTheControllerSwitchedTheJointOff) {
  LateSwitch monitored;
  const auto whole = run_closed_loop(constant_reference(ideal_plant(), 0.1, 0.5), monitored);
  EXPECT_NEAR(whole.switched_off_s.value(), 0.3, 1e-9);
  const auto half = run_closed_loop(constant_reference(ideal_plant(), 0.1, 0.2), monitored);
  EXPECT_FALSE(half.switched_off_s.has_value());
}

TEST(ClosedLoop, RepeatsARunToTheLastBit) {
  PidLoopController pid({}, 1e-3);
  const auto config = constant_reference(realistic_plant(), 0.1, 1.0);
  const auto first = run_closed_loop(config, pid);
  const auto second = run_closed_loop(config, pid);
  EXPECT_EQ(first.statistics.pi2, second.statistics.pi2) << "reset() must forget the first run";
  EXPECT_EQ(first.trace.back().joint_position_rad, second.trace.back().joint_position_rad);
}

TEST(ClosedLoop, AppliesTheLoadTorque) {
  ConstantTorque nothing(0.0);
  ClosedLoopConfig config = constant_reference(ideal_plant(), 0.5, 1.0);
  config.load_torque_Nm = TimeProfile::steps(0.0, -20.0, 0.5, 1.0, {"load_torque_Nm"});
  const auto result = run_closed_loop(config, nothing);
  EXPECT_EQ(result.trace[500].joint_position_rad, 0.0);
  EXPECT_GT(result.trace[999].joint_position_rad, 0.1);
}

TEST(ClosedLoop, RefusesARunWithoutDuration) {
  ConstantTorque nothing(0.0);
  ClosedLoopConfig config = constant_reference(ideal_plant(), 0.5, 0.0);
  EXPECT_THROW(run_closed_loop(config, nothing), InputError);
}

TEST(ClosedLoop, BringsTheSourcesPidToItsSetpoint) {
  PidLoopController pid({}, 1e-3);
  const auto result = run_closed_loop(constant_reference(torque_limited_plant(), 0.1, 3.0), pid);
  EXPECT_LT(std::abs(result.statistics.final_error_rad), 2e-3);
  EXPECT_EQ(result.statistics.peak_torque_Nm, 34.0);
}

TracePoint point(double time_s, double setpoint_rad, double position_rad, double torque_Nm,
                 double temperature_C) {
  return {time_s, setpoint_rad, position_rad, 0.0, torque_Nm, torque_Nm, temperature_C, position_rad};
}

TEST(LoopStatistics, ReadRiseSettlingAndOvershootOffTheTrace) {
  std::vector<TracePoint> trace;
  const double positions[] = {0.0, 0.5, 0.95, 1.1, 1.01, 0.99, 1.0, 1.0, 1.0, 1.005};
  for (int k = 0; k < 10; ++k) trace.push_back(point(0.1 * k, 1.0, positions[k], 1.0, 20.0));
  const LoopStatistics statistics = evaluate(trace, 0.1);
  EXPECT_NEAR(statistics.rise_time_s, 0.2, 1e-12);
  EXPECT_NEAR(statistics.settling_time_s, 0.4, 1e-12);
  EXPECT_NEAR(statistics.overshoot_rad, 0.1, 1e-12);
  EXPECT_NEAR(statistics.steady_error_rad, 0.005, 1e-12);
  EXPECT_NEAR(statistics.final_error_rad, -0.005, 1e-12);
}

TEST(LoopStatistics, JudgeTheSteadyErrorBeforeEveryJumpOfTemperature) {
  std::vector<TracePoint> trace;
  for (int k = 0; k < 20; ++k) {
    // The first temperature ends 0.3 off, the second 0.1 off; both begin far off.
    const double error_rad = k % 10 < 8 ? 0.9 : (k < 10 ? 0.3 : 0.1);
    trace.push_back(point(0.1 * k, 1.0, 1.0 - error_rad, 1.0, k < 10 ? 20.0 : 25.0));
  }
  EXPECT_NEAR(evaluate(trace, 0.1).steady_error_rad, 0.3, 1e-12);
}

TEST(LoopStatistics, CountTorqueSignChangesOnlyWhileSteady) {
  std::vector<TracePoint> trace;
  for (int k = 0; k < 100; ++k) trace.push_back(point(0.01 * k, 1.0, 1.0, k % 2 == 0 ? 1.0 : -1.0, 20.0));
  EXPECT_NEAR(evaluate(trace, 0.01).steady_sign_changes_per_s, 19.0 / 0.2, 1e-9);
}

}  // namespace
}  // namespace strainwave
