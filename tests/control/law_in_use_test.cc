// SPDX-License-Identifier: BSD-3-Clause
#include "control/law_in_use.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kCount_rad = 2e-5;

ControllerInput input_at(double error_rad, double velocity_rad_s) {
  ControllerInput input;
  input.joint_position_rad = error_rad;
  input.joint_velocity_rad_s = velocity_rad_s;
  input.torque_limit_Nm = 34.0;
  return input;
}

/// A law after 200 periods with a constant error, so that its integral is not zero.
LawInUse running(double temperature_C = 20.0) {
  LawInUse law(kPeriod_s, kCount_rad);
  law.load(testing::shipped_table("c4"));
  law.set_temperature(temperature_C);
  for (int k = 0; k < 200; ++k) law.step(input_at(1e-3, 0.0));
  return law;
}

double next_torque_Nm(LawInUse law, double velocity_rad_s = 0.3) {
  return law.step(input_at(-2e-3, velocity_rad_s)).torque_Nm;
}

TEST(LawInUse, GoesOnFromTheTorqueOfTheTableBeforeAChange) {
  const LawInUse before = running();
  const double expected_Nm = next_torque_Nm(before);
  ASSERT_LT(std::abs(expected_Nm), 30.0) << "not saturated";
  LawInUse other_table = before;
  other_table.load(testing::shipped_table("c3"));
  EXPECT_NEAR(next_torque_Nm(other_table), expected_Nm, 1e-9);
  // A second change before the next step: the torque still continues from the first table.
  other_table.load(testing::shipped_table("rhs17-6006"));
  EXPECT_NEAR(next_torque_Nm(other_table), expected_Nm, 1e-9);
}

TEST(LawInUse, ContinuesNoTorqueOnceAnotherWasApplied) {
  LawInUse law = running();
  const double expected_Nm = next_torque_Nm(law);
  law.load(testing::shipped_table("c3"));
  law.interrupt();
  EXPECT_GT(std::abs(next_torque_Nm(law) - expected_Nm), 0.01);
}

GainTable with_lead(double lead_periods) {
  GainTable led = testing::shipped_table("c4");
  led.box.lead_periods = lead_periods;
  return led;
}

TEST(LawInUse, HasTheTablesLead) {
  const auto second_torque_Nm = [](const GainTable& table) {
    LawInUse law(kPeriod_s, kCount_rad);
    law.load(table);
    law.set_temperature(20.0);
    law.step(input_at(1e-3, 0.0));
    return law.step(input_at(1.2e-3, 0.2)).torque_Nm;
  };
  const double law_Nm = second_torque_Nm(with_lead(0.0));
  EXPECT_LT(second_torque_Nm(with_lead(2.0)), 2.0 * law_Nm) << "both push back";
}

TEST(LawInUse, ACountMakesMoreWithALead) {
  LawInUse law(kPeriod_s, kCount_rad);
  law.load(with_lead(0.0));
  const double count_Nm = law.count_torque_Nm();
  law.load(with_lead(2.0));
  EXPECT_NEAR(law.count_torque_Nm(), 3.0 * count_Nm, 1e-12);
}

}  // namespace
}  // namespace strainwave
