// SPDX-License-Identifier: BSD-3-Clause
// Commissioning that ends early: the reported reason, and the time until then.
#include <gtest/gtest.h>

#include "tests/commission/commissioning_bench.h"

namespace strainwave::testing {
namespace {

TEST(Commissioning, NamesNumbersThatTheMotionDoesNotShow) {
  const RandomJoint joint = random_joint(13);  // it hardly swings
  Bench bench(joint);
  Commissioning commissioning(configure(joint));
  bench.run(commissioning);
  const CommissionRecord& record = commissioning.record();
  EXPECT_EQ(step_of(record, "motion").outcome, StepOutcome::kFailed);
  EXPECT_NE(record.problem.find("load_inertia_kgm2, stiffness_Nm_rad: not known to 5 %"), std::string::npos)
      << record.problem;
}

TEST(Commissioning, EndsWhereTheDelayIsLongerThanThatOfAnyTable) {
  const auto said_of = [](double periods) {
    return find_late({{"can.delay_periods", "periods", std::nullopt, {periods, 0.01}, std::round(periods)}});
  };
  EXPECT_EQ(said_of(2.2), "");
  EXPECT_NE(said_of(2.4).find("can.delay_periods: 2.40 periods"), std::string::npos) << said_of(2.4);
}

TEST(Commissioning, StopsAWrongDirectionBeforeAnythingFaster) {
  const RandomJoint joint = random_joint(2);
  Bench bench(joint);
  bench.scale(1.0, -1.0);
  Commissioning commissioning(configure(joint));
  bench.run(commissioning);
  const CommissionRecord& record = commissioning.record();
  EXPECT_TRUE(record.problem.starts_with("can.direction: ")) << record.problem;
  EXPECT_EQ(step_of(record, "direction").outcome, StepOutcome::kFailed);
  EXPECT_EQ(step_of(record, "friction").outcome, StepOutcome::kSkipped);
  EXPECT_LT(bench.speed_rad_s(), 0.3 * joint.excitation.limits.speed_rad_s);
}

TEST(Commissioning, NamesADriveThatGivesLessTorqueThanItIsOrdered) {
  RandomJoint joint = random_joint(2);
  joint.drive.plant.motor.peak_torque_Nm = 0.2 * joint.excitation.limits.torque_Nm;
  Bench bench(joint);
  Commissioning commissioning(configure(joint));
  bench.run(commissioning);
  EXPECT_NE(commissioning.record().problem.find("set torque_limit_Nm to what the drive can give"),
            std::string::npos)
      << bench.lines();
}

TEST(Commissioning, EndsAfterTheFirstRampsWhereNoTemperatureComes) {
  const RandomJoint joint = random_joint(2);
  Bench bench(joint);
  bench.unplug_sensor();
  Commissioning commissioning(configure(joint));
  bench.run(commissioning);
  EXPECT_EQ(step_of(commissioning.record(), "direction").outcome, StepOutcome::kFailed);
  EXPECT_NE(commissioning.record().problem.find("no temperature came"), std::string::npos);
}

}  // namespace
}  // namespace strainwave::testing
