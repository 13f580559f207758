// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/time_optimal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/input_error.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/loop_controllers.h"
#include "sim/studies/scenarios.h"

namespace strainwave {
namespace {

TEST(TimeOptimal, IsTheYardstickOfTheTheoryAtMinus10C) {
  const double expected_pi2[] = {2.18, 5.91, 18.4, 69.7};
  const double expected_arrival_ms[] = {3.3, 10.3, 33.6, 127.0};
  for (int range = 0; range < kRangeCount; ++range) {
    ClosedLoopConfig config = scenario_config(Scenario::kRamp, range, torque_limited_plant());
    config.ambient = TemperatureProfile::constant(-10.0);
    const auto result = run_time_optimal(config);
    EXPECT_NEAR(result.statistics.pi2, expected_pi2[range], 6e-3 * expected_pi2[range]);
    EXPECT_NEAR(1e3 * result.first_arrival_s, expected_arrival_ms[range], 0.02 * expected_arrival_ms[range]);
    EXPECT_EQ(result.statistics.final_error_rad, 0.0);
    EXPECT_LE(result.statistics.overshoot_rad, 1e-12);
  }
}

TEST(TimeOptimal, TakesTheTimeThatTheParabolasSayUnderConstantFriction) {
  ClosedLoopConfig config = scenario_config(Scenario::kRamp, 1, torque_limited_plant());
  config.plant.joint.friction = {{4.0, 4.0, 0.0}, {}, 0.0, 1.0};
  const double up = (34.0 - 4.0) / config.plant.joint.inertia_kgm2;
  const double down = (34.0 + 4.0) / config.plant.joint.inertia_kgm2;
  const double speed = std::sqrt(2.0 * 0.01 / (1.0 / up + 1.0 / down));
  EXPECT_NEAR(run_time_optimal(config).first_arrival_s, speed / up + speed / down, 1e-11);
}

TEST(TimeOptimal, IsSlowerWhenBackEmfLimitsTheSpeed) {
  const auto arrival_s = [](const JointPlantConfig& plant) {
    return run_time_optimal(scenario_config(Scenario::kRamp, 3, plant)).first_arrival_s;
  };
  EXPECT_GT(arrival_s(realistic_plant()), 1.1 * arrival_s(torque_limited_plant()));
}

TEST(TimeOptimal, IsNotBeatenByThePid) {
  for (const Scenario scenario : kScenarios) {
    for (int range = 0; range < kRangeCount; ++range) {
      const ClosedLoopConfig config = scenario_config(scenario, range, torque_limited_plant());
      PidLoopController pid({}, config.plant.period_s);
      EXPECT_LT(run_time_optimal(config).statistics.pi2, run_closed_loop(config, pid).statistics.pi2);
    }
  }
}

TEST(TimeOptimal, FollowsEveryStepOfTheStaircaseDownwardsToo) {
  ClosedLoopConfig config = scenario_config(Scenario::kStaircase, 2, torque_limited_plant());
  const double upwards = run_time_optimal(config).statistics.pi2;
  config.setpoint_rad = TimeProfile::steps(-0.1, -0.2, 1.0, 4.0, {"setpoint_rad"});
  EXPECT_NEAR(run_time_optimal(config).statistics.pi2, upwards, 1e-9 * upwards);
}

TEST(TimeOptimal, PushesAsLongAsTheRunLastsWhereTheSetpointIsTooFar) {
  ClosedLoopConfig config;
  config.plant = torque_limited_plant();
  config.plant.joint.friction.asymptote.viscous_Nms_rad = 1000.0;
  config.ambient = TemperatureProfile::constant(20.0);
  config.setpoint_rad = TimeProfile::constant(1.0, {"setpoint_position_rad"});
  config.duration_s = 0.5;
  const TimeOptimalResult result = run_time_optimal(config);
  EXPECT_LT(result.first_arrival_s, 0.0) << "it has not arrived";
  ASSERT_EQ(result.trace.size(), 500U);
  EXPECT_GT(result.statistics.final_error_rad, 0.9);
  for (const TracePoint& point : result.trace) EXPECT_EQ(point.applied_torque_Nm, kReferencePeakTorque_Nm);
}

TEST(TimeOptimal, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(run_time_optimal(scenario_config(Scenario::kRamp, 0, ideal_plant())), InputError);
  ClosedLoopConfig weak = scenario_config(Scenario::kRamp, 0, torque_limited_plant());
  weak.plant.motor.peak_torque_Nm = 1.0;
  EXPECT_THROW(run_time_optimal(weak), InputError);
  ClosedLoopConfig hasty = scenario_config(Scenario::kRamp, 0, torque_limited_plant());
  hasty.setpoint_rad = TimeProfile::steps(1.0, 1.0, 0.02, 10.0, {"setpoint_rad"});
  EXPECT_THROW(run_time_optimal(hasty), InputError);
}

}  // namespace
}  // namespace strainwave
