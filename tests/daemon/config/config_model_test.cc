// SPDX-License-Identifier: BSD-3-Clause
// joint.model: the keys of flexible and rigid joints, and the refusals for each.
#include "tests/daemon/config/config_file_test.h"

namespace strainwave {
namespace {

const std::string kModelLines = "model = \"rigid\"";

class ModelConfigTest : public ConfigFileTest {
 protected:
  static std::string rigid() { return example("demo.toml"); }
  /// The demo's joint with these lines in place of its model and inertia.
  static std::string joint_with(const std::string& lines) {
    return replaced(replaced(rigid(), "inertia_kgm2 = 0.089\n", ""), kModelLines, lines + "\n#");
  }
  static std::string flexible(const std::string& gear = "gear = \"csf-17-50\"",
                              const std::string& load = "load_inertia_kgm2 = 0.1") {
    return joint_with("model = \"flexible\"\nmotor_inertia_kgm2 = 0.089\n" + gear + "\n" + load);
  }
  static std::string controlled(const std::string& joint, const std::string& control) {
    return replaced(joint, "[joint.simulated]", "[joint.control]\n" + control + "\n[joint.simulated]");
  }
  const JointConfig& joint_of(const std::string& text) {
    config_ = read(text);
    return config_.joints.front();
  }
  DaemonConfig config_;
};

TEST_F(ModelConfigTest, OfAFlexibleJointIsTheGearsSpringBetweenMotorAndLoad) {
  const JointConfig& joint = joint_of(flexible());
  const JointControllerConfig& controller = joint.loop.controller;
  ASSERT_TRUE(controller.link.has_value());
  EXPECT_EQ(controller.link->link_inertia_kgm2, 0.1);
  EXPECT_EQ(controller.link->motor_inertia_kgm2, 0.089);
  EXPECT_EQ(controller.link->spring.stiffness_1_Nm_rad, 8100.0);
  EXPECT_EQ(joint.plant.gear.view(), "csf-17-50") << "what tables are compared with";
  EXPECT_DOUBLE_EQ(joint.plant.inertia_kgm2, 0.189) << "of both together";
}

TEST_F(ModelConfigTest, OfARigidJointIsOneInertiaWithoutALink) {
  const JointConfig& joint = joint_of(rigid());
  const JointControllerConfig& controller = joint.loop.controller;
  EXPECT_FALSE(controller.link.has_value());
  EXPECT_EQ(joint.plant.inertia_kgm2, 0.089);
  EXPECT_EQ(joint.plant.gear.view(), "");
}

TEST_F(ModelConfigTest, TakesOneSlopeOrThreeInPlaceOfAGear) {
  const TorsionSpring one = joint_of(flexible("stiffness_Nm_rad = 9000")).loop.controller.link->spring;
  EXPECT_EQ(one.torque_Nm(0.001), 9.0);
  EXPECT_EQ(one.torque_Nm(0.01), 90.0);
  EXPECT_EQ(config_.joints.front().plant.gear.view(), "");
  const TorsionSpring three =
      joint_of(flexible("stiffness_Nm_rad = [8100, 11000, 13000]\nstiffness_torques_Nm = [3.9, 12]"))
          .loop.controller.link->spring;
  const TorsionSpring catalogue = joint_of(flexible()).loop.controller.link->spring;
  for (const double angle_rad : {-0.002, 0.0003, 0.0008, 0.005})
    EXPECT_EQ(three.torque_Nm(angle_rad), catalogue.torque_Nm(angle_rad)) << angle_rad;
}

TEST_F(ModelConfigTest, RefusesStiffnessesThatAreNone) {
  expect_mentions(error_of(flexible("stiffness_Nm_rad = [8100, 11000, 13000]")),
                  {"joint[0].stiffness_Nm_rad", "a number"});
  expect_mentions(error_of(flexible("stiffness_Nm_rad = [8100, 11000]\nstiffness_torques_Nm = [3.9, 12]")),
                  {"joint[0].stiffness_Nm_rad", "[K1, K2, K3]"});
  expect_mentions(
      error_of(flexible("stiffness_Nm_rad = [8100, 11000, 13000]\nstiffness_torques_Nm = [12, 3.9]")),
      {"joint[0].stiffness_torques_Nm", "two rising torques"});
  expect_mentions(error_of(flexible("gear = \"csf-17-50\"\nstiffness_torques_Nm = [3.9, 12]")),
                  {"joint[0].stiffness_torques_Nm", "only without gear"});
  expect_mentions(error_of(flexible("gear = \"csf-17-50\"\nstiffness_Nm_rad = 80000")),
                  {"joint[0].stiffness_Nm_rad", "4050 to 16200"});
}

TEST_F(ModelConfigTest, ScalesAGearToTheFirstSlopeThatWasMeasured) {
  const TorsionSpring measured =
      joint_of(flexible("gear = \"csf-17-50\"\nstiffness_Nm_rad = 9720")).loop.controller.link->spring;
  EXPECT_EQ(config_.joints.front().plant.gear.view(), "csf-17-50");
  const TorsionSpring catalogue = joint_of(flexible()).loop.controller.link->spring;
  for (const double angle_rad : {-0.0003, 0.0003})
    EXPECT_NEAR(measured.torque_Nm(angle_rad), 1.2 * catalogue.torque_Nm(angle_rad), 1e-9) << angle_rad;
  EXPECT_NEAR(measured.stiffness_3_Nm_rad, 1.2 * catalogue.stiffness_3_Nm_rad, 1e-6);
  EXPECT_EQ(measured.torque_2_Nm, catalogue.torque_2_Nm);
}

TEST_F(ModelConfigTest, IsRefusedWhereItIsMissingWithTheLinesOfBothAndTheirSources) {
  expect_mentions(error_of(joint_with("inertia_kgm2 = 0.089")),
                  {"joint[0].model is missing", "model = \"flexible\"", "gear = \"csf-17-50\"",
                   "motor_inertia_kgm2", "rotor inertia of the data sheet times gear_ratio squared",
                   "load_inertia_kgm2", "mass times lever squared", "model = \"rigid\"", "inertia_kgm2"});
}

TEST_F(ModelConfigTest, OfAFlexibleJointIsRefusedWithAllLinesThatAreMissingAndNoOther) {
  expect_mentions(error_of(joint_with("model = \"flexible\"")),
                  {"joint[0].gear is missing", "K1 of the gear's data sheet",
                   "motor_inertia_kgm2 = ", "load_inertia_kgm2 = "});
  const std::string no_load = error_of(flexible("gear = \"csf-17-50\"", ""));
  expect_mentions(no_load, {"joint[0].load_inertia_kgm2 is missing", "load_inertia_kgm2 = "});
  EXPECT_EQ(no_load.find("motor_inertia_kgm2"), std::string::npos) << no_load;
}

TEST_F(ModelConfigTest, OfAGearWithAnotherRatioIsRefusedTogetherWithAllOtherErrorsOfTheFile) {
  const std::string wrong = replaced(flexible(), "torque_limit_Nm = 34", "torque_limit_Nm = -34");
  expect_mentions(error_of(replaced(wrong, "gear_ratio = 50", "gear_ratio = 100")),
                  {"but joint.gear_ratio = 100", "torque_limit_Nm = -34"});
  const std::string impossible = error_of(replaced(wrong, "gear_ratio = 50", "gear_ratio = 0"));
  expect_mentions(impossible, {"joint[0].gear_ratio = 0", "torque_limit_Nm = -34"});
  EXPECT_EQ(impossible.find("a gear of"), std::string::npos) << "it follows: " << impossible;
}

TEST_F(ModelConfigTest, RefusesTheKeysOfTheOtherModelWithTheReason) {
  expect_mentions(error_of(flexible("gear = \"csf-17-50\"\ninertia_kgm2 = 0.189")),
                  {"joint[0].inertia_kgm2 = 0.189", "only with model = \"rigid\"", "a spring is between"});
  for (const char* line : {"gear = \"csf-17-50\"", "stiffness_Nm_rad = 8100", "stiffness_torques_Nm = [1, 2]",
                           "motor_inertia_kgm2 = 0.089", "load_inertia_kgm2 = 0.1", "damping_Nms_rad = 0.8"})
    expect_mentions(error_of(replaced(rigid(), "inertia_kgm2 = 0.089\n",
                                      std::string("inertia_kgm2 = 0.089\n") + line + "\n")),
                    {"joint[0].", "only with model = \"flexible\"", "one inertia"});
}

TEST_F(ModelConfigTest, TakesDampingUpToHalfOfCriticalAndElseDoesNotKnowIt) {
  const auto damped = [](const std::string& damping) {
    return flexible("gear = \"csf-17-50\"\ndamping_Nms_rad = " + damping);
  };
  EXPECT_EQ(joint_of(flexible()).loop.controller.link->damping_Nms_rad, 0.0);
  EXPECT_EQ(joint_of(damped("0.8")).loop.controller.link->damping_Nms_rad, 0.8);
  EXPECT_EQ(joint_of(damped("19.5")).loop.controller.link->damping_Nms_rad, 19.5);
  // Half of 2 sqrt(K / (1 / Jm + 1 / Jl)), where K is the gear's first slope.
  expect_mentions(error_of(damped("19.6")), {"joint[0].damping_Nms_rad = 19.6", "from 0 to 19.53"});
  expect_mentions(error_of(damped("-1.0")), {"joint[0].damping_Nms_rad = -1", "from 0"});
}

// The controller counts positions as the drive does. Homing shifts positions from outside, but not the weight.
TEST_F(ModelConfigTest, RefusesAWeightWherePositionsAreFoundByHoming) {
  const std::string homing = "\n[joint.homing]\nto = \"stop\"\nstop_torque_Nm = 3.0\n";
  EXPECT_NO_THROW(read(flexible() + homing));
  expect_mentions(error_of(controlled(flexible(), "gravity_Nm = 3.0\ngravity_zero_rad = -0.5") + homing),
                  {"homing.to", "stop", "gravity_Nm"});
}

TEST_F(ModelConfigTest, RefusesGearsAndLoadsThatCannotBe) {
  expect_mentions(error_of(flexible("gear = \"csf-18-50\"")),
                  {"joint[0].gear = \"csf-18-50\"", "csf-17-50", "stiffness_Nm_rad"});
  expect_mentions(error_of(flexible("gear = \"csf-17-100\"")), {"joint[0].gear", "gear_ratio = 50"});
  expect_mentions(error_of(flexible("gear = \"csf-17-50\"", "load_inertia_kgm2 = 90")),
                  {"joint[0].load_inertia_kgm2 = 90", "from 8.9e-05 to 89"});
  expect_mentions(error_of(joint_with("model = \"springy\"")),
                  {"joint[0].model = \"springy\"", "\"flexible\", \"rigid\""});
}

}  // namespace
}  // namespace strainwave
