// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/identify_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "strainwave/client_error.h"

namespace strainwave {
namespace {

limits_v1 limits() {
  limits_v1 message{};
  message.position_min_rad = -2.0;
  message.position_max_rad = 3.0;
  message.speed_limit_rad_s = 6.0;
  message.acceleration_rad_s2 = 150.0;
  message.deceleration_rad_s2 = 100.0;
  message.torque_limit_Nm = 34.0;
  return message;
}

std::string refusal(const IdentifyArguments& arguments, double position_rad = 0.0) {
  try {
    plan_identification(arguments, limits(), position_rad);
  } catch (const ClientError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kUsage);
    return error.what();
  }
  return "";
}

TEST(IdentifyPlan, NeverLeavesTheRangeTheSpeedLimitOrTheLimitsOfTheJoint) {
  for (const double position_rad : {-2.0, -1.5, 0.0, 2.9}) {
    const IdentifyPlan plan = plan_identification({}, limits(), position_rad);
    EXPECT_GE(plan.range_rad.first, -2.0);
    EXPECT_LE(plan.range_rad.second, 3.0);
    EXPECT_LE(plan.range_rad.second - plan.range_rad.first, 2.0);
    for (const Sweep& sweep : plan.sweeps) {
      EXPECT_GE(sweep.from_rad, plan.range_rad.first - 1e-12);
      EXPECT_LE(sweep.to_rad, plan.range_rad.second + 1e-12);
      EXPECT_LT(sweep.from_rad, sweep.to_rad);
      EXPECT_LE(sweep.speed_rad_s, limits().speed_limit_rad_s);
    }
    EXPECT_LE(plan.approach_speed_rad_s, limits().speed_limit_rad_s);
  }
}

TEST(IdentifyPlan, HoldsEachSpeedAsLongAsItSays) {
  const IdentifyPlan plan = plan_identification({}, limits(), 0.0);
  ASSERT_EQ(plan.sweeps.size(), 12U);
  for (const Sweep& sweep : plan.sweeps) {
    const double v = sweep.speed_rad_s;
    const double ramps_rad = 0.5 * v * v * (1.0 / 150.0 + 1.0 / 100.0);
    EXPECT_NEAR(sweep.to_rad - sweep.from_rad, ramps_rad + v * sweep.steady_s, 1e-9);
    EXPECT_GE(sweep.steady_s, kLeastSteady_s);
    EXPECT_LE(sweep.steady_s, 4.0 + 1e-9);
  }
}

TEST(IdentifyPlan, GoesFromSlowToFastInEvenRatios) {
  const IdentifyPlan plan = plan_identification({}, limits(), 0.0);
  EXPECT_NEAR(plan.sweeps.front().speed_rad_s, 0.025, 1e-12);
  EXPECT_NEAR(plan.sweeps.back().speed_rad_s, 4.8, 1e-12);
  const double ratio = plan.sweeps[1].speed_rad_s / plan.sweeps[0].speed_rad_s;
  for (std::size_t i = 1; i < plan.sweeps.size(); ++i)
    EXPECT_NEAR(plan.sweeps[i].speed_rad_s / plan.sweeps[i - 1].speed_rad_s, ratio, 1e-9);
}

TEST(IdentifyPlan, LeavesOutSpeedsThatTheRangeIsTooShortFor) {
  IdentifyArguments arguments;
  arguments.range_rad = {-0.1, 0.1};
  const IdentifyPlan plan = plan_identification(arguments, limits(), 0.0);
  EXPECT_FALSE(plan.left_out_rad_s.empty());
  EXPECT_EQ(plan.sweeps.size() + plan.left_out_rad_s.size(), 12U);
  EXPECT_GT(*std::ranges::min_element(plan.left_out_rad_s), plan.sweeps.back().speed_rad_s);
  EXPECT_NE(to_text(plan).find("left out"), std::string::npos);
  arguments.range_rad = {-0.001, 0.001};
  EXPECT_NE(refusal(arguments).find("--range_rad"), std::string::npos);
}

TEST(IdentifyPlan, RefusesWhatIsBeyondTheLimitsAndNamesThem) {
  IdentifyArguments arguments;
  arguments.range_rad = {-2.1, 0.0};
  EXPECT_NE(refusal(arguments, -1.0).find("-2 to 3"), std::string::npos);
  arguments.range_rad = {1.0, 0.5};
  EXPECT_NE(refusal(arguments).find("below the second"), std::string::npos);
  arguments.range_rad = {0.5, 1.0};
  EXPECT_NE(refusal(arguments, 0.0).find("move it there first"), std::string::npos);
  arguments = {};
  arguments.fastest_rad_s = 6.1;
  EXPECT_NE(refusal(arguments).find("limit is 6"), std::string::npos);
  arguments = {};
  arguments.slowest_rad_s = 5.0;
  EXPECT_NE(refusal(arguments).find("--slowest_rad_s"), std::string::npos);
  arguments = {};
  arguments.max_torque_Nm = 35.0;
  EXPECT_NE(refusal(arguments).find("limit is 34"), std::string::npos);
}

TEST(IdentifyPlan, AsJsonHasEverySweep) {
  const IdentifyPlan plan = plan_identification({}, limits(), 0.0);
  const auto json = nlohmann::json::parse(to_json(plan, "elbow"));
  EXPECT_EQ(json.at("joint"), "elbow");
  EXPECT_EQ(json.at("max_torque_Nm"), plan.max_torque_Nm);
  ASSERT_EQ(json.at("sweeps").size(), plan.sweeps.size());
  EXPECT_EQ(json.at("sweeps").front().at("speed_rad_s"), plan.sweeps.front().speed_rad_s);
  EXPECT_EQ(json.at("left_out_rad_s").size(), plan.left_out_rad_s.size());
}

}  // namespace
}  // namespace strainwave
