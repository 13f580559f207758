// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_load.h"

#include "tests/daemon/config/config_file_test.h"

namespace strainwave {
namespace {

class LoadConfigTest : public ConfigFileTest {
 protected:
  /// The demo's joint with other limits and control keys.
  static std::string joint_with(const std::string& limits, const std::string& control = "") {
    return replaced(replaced(example("demo.toml"), "acceleration_rad_s2 = 30 ", limits + "\n#"),
                    "[joint.simulated]", "[joint.control]\n" + control + "\n[joint.simulated]");
  }
  /// The same for a flexible joint whose motor and load together have the same inertia.
  static std::string flexible_with(const std::string& limits, const std::string& control) {
    return replaced(replaced(joint_with(limits, control), "inertia_kgm2 = 0.089",
                             "motor_inertia_kgm2 = 0.049\nload_inertia_kgm2 = 0.04\ngear = \"csf-17-50\""),
                    "\"rigid\"", "\"flexible\"");
  }
  LoadLimits limits_of(const std::string& text) {
    const JointLoopConfig loop = read(text).joints.front().loop;
    return loop.limits.load.under(loop.controller.torque_limit_Nm);
  }
};

TEST_F(LoadConfigTest, IsWhatTheTorqueLimitLeavesAJointThatAccelerates) {
  const LoadLimits limits = limits_of(joint_with("acceleration_rad_s2 = 150"));
  EXPECT_NEAR(limits.load_Nm, 34.0 - 0.089 * 150.0, 1e-12);
  EXPECT_NEAR(limits.notice_Nm, 0.8 * limits.load_Nm, 1e-12);
}

TEST_F(LoadConfigTest, CountsTheHarderOfAccelerationAndDeceleration) {
  EXPECT_NEAR(limits_of(joint_with("acceleration_rad_s2 = 100\ndeceleration_rad_s2 = 150")).load_Nm, 20.65,
              1e-12);
  EXPECT_NEAR(limits_of(joint_with("acceleration_rad_s2 = 150\ndeceleration_rad_s2 = 100")).load_Nm, 20.65,
              1e-12);
}

TEST_F(LoadConfigTest, IsHalfToFourFifthsOfWhatGravityLeaves) {
  EXPECT_NEAR(limits_of(joint_with("acceleration_rad_s2 = 30")).load_Nm, 0.8 * 34.0, 1e-12);
  EXPECT_NEAR(limits_of(joint_with("acceleration_rad_s2 = 1000")).load_Nm, 0.5 * 34.0, 1e-12);
  const std::string weight = "gravity_Nm = 4\ngravity_zero_rad = 0";
  EXPECT_NEAR(limits_of(flexible_with("acceleration_rad_s2 = 30", weight)).load_Nm, 0.8 * 30.0, 1e-12);
  EXPECT_NEAR(limits_of(flexible_with("acceleration_rad_s2 = 150", weight)).load_Nm, 30.0 - 13.35, 1e-12);
  EXPECT_NEAR(limits_of(flexible_with("acceleration_rad_s2 = 1000", weight)).load_Nm, 0.5 * 30.0, 1e-12);
}

TEST_F(LoadConfigTest, IsATenthOfTheTorqueLimitWhereTheWeightTakesAllOfIt) {
  EXPECT_NEAR(
      limits_of(flexible_with("acceleration_rad_s2 = 30", "gravity_Nm = 34\ngravity_zero_rad = 0")).load_Nm,
      3.4, 1e-12);
}

TEST_F(LoadConfigTest, IsAQuarterAboveWhatTheJointIsToldToCarryOrToPressWith) {
  for (const char* carried : {"initial_load_Nm = 20", "initial_load_Nm = -20"})
    EXPECT_NEAR(limits_of(joint_with("acceleration_rad_s2 = 150", carried)).load_Nm, 25.0, 1e-12);
  const std::string homing = "\n[joint.homing]\nto = \"stop\"\nstop_torque_Nm = 24\n";
  EXPECT_NEAR(limits_of(joint_with("acceleration_rad_s2 = 150") + homing).load_Nm, 30.0, 1e-12);
}

TEST_F(LoadConfigTest, IsWhatTheConfigurationSaysWhereItSaysIt) {
  const LoadLimits limits = limits_of(joint_with("acceleration_rad_s2 = 150\nload_Nm = 40"));
  EXPECT_EQ(limits.load_Nm, 40.0);
  EXPECT_EQ(limits.notice_Nm, 32.0);
  EXPECT_EQ(limits_of(joint_with("acceleration_rad_s2 = 150\nload_notice_Nm = 5")).notice_Nm, 5.0);
  expect_mentions(error_of(joint_with("acceleration_rad_s2 = 150\nload_notice_Nm = 21")),
                  {"limits.load_notice_Nm = 21", "20.65"});
  expect_mentions(error_of(joint_with("acceleration_rad_s2 = 150\nload_Nmm = 21")), {"load_Nmm", "load_Nm"});
}

}  // namespace
}  // namespace strainwave
