#include "tests/daemon/config/config_file_test.h"

namespace strainwave {
namespace {

class LinkConfigTest : public ConfigFileTest {
 protected:
  /// The demo's joint with other control keys.
  static std::string joint_with(const std::string& control) {
    const std::string demo = replaced(example("demo.toml"), "inertia_kgm2 = 0.089", "inertia_kgm2 = 0.189");
    return replaced(demo, "rigid = true ", control + " ");
  }
};

TEST_F(LinkConfigTest, AGearAndItsLoadMakeTheControllersLink) {
  const DaemonConfig config = read(joint_with("gear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1"));
  const JointControllerConfig& controller = config.joints.front().loop.controller;
  ASSERT_TRUE(controller.link.has_value());
  EXPECT_DOUBLE_EQ(controller.link->link_inertia_kgm2, 0.1);
  EXPECT_NEAR(controller.link->motor_inertia_kgm2, 0.089, 1e-12);
  EXPECT_EQ(controller.link->spring.stiffness_1_Nm_rad, 8100.0);
  EXPECT_EQ(config.joints.front().plant.gear.view(), "csf-17-50") << "what tables are compared with";
}

TEST_F(LinkConfigTest, WithoutAGearThereIsNoLink) {
  EXPECT_FALSE(read(joint_with("rigid = false")).joints.front().loop.controller.link.has_value());
}

TEST_F(LinkConfigTest, TheSpringsDampingIsToldWithAGearUpToHalfOfCriticalAndElseNotKnown) {
  const std::string link = "gear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1";
  const auto damping_Nms_rad = [&](const std::string& text) {
    return read(text).joints.front().loop.controller.link->damping_Nms_rad;
  };
  EXPECT_EQ(damping_Nms_rad(joint_with(link)), 0.0);
  EXPECT_EQ(damping_Nms_rad(joint_with(link + "\ndamping_Nms_rad = 0.8")), 0.8);
  EXPECT_EQ(damping_Nms_rad(joint_with(link + "\ndamping_Nms_rad = 19.5")), 19.5);
  // Half of 2 sqrt(K / (1 / Jm + 1 / Jl)), K the gear's first slope.
  expect_mentions(error_of(joint_with(link + "\ndamping_Nms_rad = 19.6")),
                  {"joint[0].control.damping_Nms_rad = 19.6", "from 0 to 19.53"});
  expect_mentions(error_of(joint_with(link + "\ndamping_Nms_rad = -1.0")),
                  {"joint[0].control.damping_Nms_rad = -1", "from 0"});
  expect_mentions(error_of(joint_with("damping_Nms_rad = 0.8")),
                  {"joint[0].control.damping_Nms_rad", "only with a gear"});
}

// As gear and load it is the joint's, which [joint.control] alone tells: a simulated one may so be another than is told.
TEST_F(LinkConfigTest, ASimulatedSpringsDampingIsNotToldByItself) {
  const std::string text = joint_with("gear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1") +
                           "\ngear = \"csf-17-50\"\ninertia_kgm2 = 0.089\n"
                           "[joint.simulated.link]\ninertia_kgm2 = 0.1\n"
                           "[joint.simulated.spring]\ndamping_Nms_rad = 0.8\n";
  const DaemonConfig config = read(text);
  const JointConfig& joint = config.joints.front();
  EXPECT_EQ(std::get<SimulatedDrive>(joint.drive).actuator.plant.effects.transmission->damping_Nms_rad, 0.8);
  EXPECT_EQ(joint.loop.controller.link->damping_Nms_rad, 0.0);
}

TEST_F(LinkConfigTest, AWeightIsToldWithOrWithoutAGearAndOnlyWhereNothingElseFindsIt) {
  const std::string weight = "gravity_Nm = 3.0\ngravity_zero_rad = -0.5";
  for (const std::string& rest :
       {std::string(), std::string("\ngear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1")}) {
    const DaemonConfig config = read(joint_with(weight + rest));
    EXPECT_EQ(config.joints.front().loop.controller.gravity.torque_Nm, 3.0);
    EXPECT_EQ(config.joints.front().loop.controller.gravity.zero_rad, -0.5);
  }
  expect_mentions(error_of(joint_with("rigid = true\n" + weight)), {"gravity_Nm", "observer"});
  expect_mentions(error_of(joint_with("gravity_Nm = 3.0")), {"gravity_zero_rad", "missing"});
  expect_mentions(error_of(joint_with("gravity_zero_rad = 3.0")), {"gravity_zero_rad", "gravity_Nm"});
  expect_mentions(error_of(joint_with("gravity_Nm = 1e3\ngravity_zero_rad = 0")),
                  {"gravity_Nm", "1000", "0 to 34"});
}

// The controller counts as the drive does; homing moves what comes from outside, and not the weight.
TEST_F(LinkConfigTest, AWeightIsRefusedWherePositionsAreFoundByHoming) {
  const std::string homing = "\n[joint.homing]\nto = \"positive_stop\"\nstop_torque_Nm = 3.0\n";
  EXPECT_NO_THROW(read(joint_with("rigid = false") + homing));
  expect_mentions(error_of(joint_with("gravity_Nm = 3.0\ngravity_zero_rad = -0.5") + homing),
                  {"homing.to", "positive_stop", "gravity_Nm"});
}

TEST_F(LinkConfigTest, RefusesWhatCannotBe) {
  expect_mentions(error_of(joint_with("gear = \"csf-18-50\"\nload_inertia_kgm2 = 0.1")),
                  {"gear", "csf-18-50", "csf-17-50"});
  expect_mentions(error_of(joint_with("gear = \"csf-17-100\"\nload_inertia_kgm2 = 0.1")),
                  {"gear", "gear_ratio"});
  expect_mentions(error_of(joint_with("gear = \"csf-17-50\"")), {"load_inertia_kgm2"});
  expect_mentions(error_of(joint_with("gear = \"csf-17-50\"\nload_inertia_kgm2 = 0.19")),
                  {"load_inertia_kgm2", "0.19"});
  expect_mentions(error_of(joint_with("load_inertia_kgm2 = 0.1")), {"load_inertia_kgm2", "gear"});
  expect_mentions(error_of(joint_with("rigid = true\ngear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1")),
                  {"gear", "rigid"});
  expect_mentions(error_of(joint_with("shaping = false\ngear = \"csf-17-50\"\nload_inertia_kgm2 = 0.1")),
                  {"gear", "shaping"});
}

}  // namespace
}  // namespace strainwave
