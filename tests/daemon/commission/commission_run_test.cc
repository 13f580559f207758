// SPDX-License-Identifier: BSD-3-Clause
// Complete runs, which take seconds each.
#include <gtest/gtest.h>

#include "tests/daemon/commission/simulated_arm.h"

namespace strainwave {
namespace {

TEST_F(CommissionTest, MeasuresASimulatedJointAsConfigured) {
  EXPECT_EQ(run(kArm), ExitStatus::kDone) << out_.str();
  const CommissionRecord found = record();
  EXPECT_EQ(found.problem, "");
  EXPECT_TRUE(found.simulated);
  EXPECT_LT(found.joint_time_s, 180.0);
  EXPECT_NEAR(found.temperature_C.value_or(0.0), 20.0, 5.0);
  for (const char* name : {"identity", "direction", "breakaway", "friction", "motion", "comparison"})
    EXPECT_NE(out_.str().find(std::string("  ") + name + ": "), std::string::npos) << name;

  std::ostringstream again;
  EXPECT_EQ(
      commission_joint(read_config(folder_ / "c.toml"), folder_ / "c.toml", "elbow", folder_ / "out", again),
      ExitStatus::kDone);
  EXPECT_NE(again.str().find("motion: done before, not run again"), std::string::npos) << again.str();
  EXPECT_EQ(record().joint_time_s, found.joint_time_s) << "nothing has moved";
}

TEST_F(CommissionTest, MeasuresAnInertiaThatIsNotConfiguredAndEndsWithTheNameOfOneThatIsWrong) {
  std::string text = replaced(kArm, "motor_inertia_kgm2 = 0.089\n", "");
  text.append("inertia_kgm2 = 0.06\n[joint.simulated.link]\ninertia_kgm2 = 0.2\n");
  EXPECT_TRUE(error_of(text).find("motor_inertia_kgm2") != std::string::npos) << "the daemon needs it";
  EXPECT_EQ(run(text), ExitStatus::kRefused) << out_.str();
  EXPECT_TRUE(record().problem.starts_with("load_inertia_kgm2 = 0.1 is wrong: ")) << record().problem;
  for (const CommissionValue& value : record().values) {
    if (value.key == "motor_inertia_kgm2") {
      EXPECT_NEAR(value.measured.value, 0.06, 0.003);
      EXPECT_FALSE(value.configured);
    } else if (value.key == "load_inertia_kgm2") {
      EXPECT_NEAR(value.measured.value, 0.2, 0.01);
      EXPECT_EQ(value.configured, 0.1);
    }
  }
}

}  // namespace
}  // namespace strainwave
