// SPDX-License-Identifier: BSD-3-Clause
// Allowed settings of a simulated joint with a spring, and of its controller.
#include "sim/joint/reference_plant.h"
#include "tests/daemon/config/config_file_test.h"

namespace strainwave {
namespace {

class SimulatedConfigTest : public ConfigFileTest {
 protected:
  /// The demo's joint, with one inertia, these keys of [joint.simulated], and tables below it.
  static std::string rigid_with(const std::string& tables, const std::string& keys = "") {
    return example("demo.toml") + keys + tables;
  }
  /// The same for a flexible joint.
  static std::string flexible_with(const std::string& tables, const std::string& keys = "") {
    return replaced(replaced(rigid_with(tables, keys), "inertia_kgm2 = 0.089",
                             "motor_inertia_kgm2 = 0.089\nload_inertia_kgm2 = 0.1\ngear = \"csf-17-50\"\n"
                             "damping_Nms_rad = 0.8"),
                    "\"rigid\"", "\"flexible\"");
  }
  /// A rigid joint in front of a link that its model does not have.
  static std::string joint_with(const std::string& tables, const std::string& keys = "") {
    return rigid_with(tables, "gear = \"csf-17-50\"\ninertia_kgm2 = 0.089\n" + keys);
  }
  static std::string link(const std::string& lines) {
    return "[joint.simulated.link]\ninertia_kgm2 = 0.1\n" + lines;
  }
  const JointPlantConfig& plant(const std::string& text) {
    config_ = read(text);
    return std::get<SimulatedDrive>(config_.joints.front().drive).actuator.plant;
  }
  const JointControllerConfig& controller(const std::string& text) {
    config_ = read(text);
    return config_.joints.front().loop.controller;
  }
  DaemonConfig config_;
};

const char* const kEncoder = "[joint.simulated.link_encoder]\ncounts_per_joint_revolution = 1e6\n";

TEST_F(SimulatedConfigTest, TellsTheControllerWhatIsTrueOfTheDriveUnlessToldOtherwise) {
  const std::string late = link("[joint.simulated.drive]\ndelay_periods = 2.4\n");
  EXPECT_EQ(controller(joint_with(late)).delay_periods, 2);
  EXPECT_EQ(controller(joint_with(late, "delay_periods = 1\n")).delay_periods, 1);
  EXPECT_EQ(std::get<SimulatedDrive>(config_.joints.front().drive).actuator.plant.delay.periods, 2.4);
  expect_mentions(error_of(joint_with(link("[joint.simulated.drive]\ndelay_periods = 12\n"))),
                  {"joint[0].simulated.delay_periods", "0 to 8"});
}

TEST_F(SimulatedConfigTest, IsTheJointsOwnModelWhereNothingElseIsSaid) {
  const JointPlantConfig rigid = plant(rigid_with(""));
  EXPECT_FALSE(rigid.effects.transmission.has_value());
  EXPECT_EQ(rigid.joint.inertia_kgm2, 0.089);
  const JointPlantConfig flexible = plant(flexible_with(""));
  ASSERT_TRUE(flexible.effects.transmission.has_value());
  EXPECT_EQ(flexible.joint.inertia_kgm2, 0.089) << "the motor's alone";
  EXPECT_EQ(flexible.effects.transmission->link_inertia_kgm2, 0.1);
  EXPECT_EQ(flexible.effects.transmission->spring.stiffness_3_Nm_rad, 13000.0);
  EXPECT_EQ(flexible.effects.transmission->damping_Nms_rad, 0.8);
}

TEST_F(SimulatedConfigTest, HasTheMotorOfTheReferenceJointOnlyWhereItIsThatJoint) {
  EXPECT_EQ(plant(rigid_with("")).motor.peak_torque_Nm, kReferencePeakTorque_Nm);
  const std::string another =
      replaced(replaced(flexible_with(""), "gear_ratio = 50", "gear_ratio = 100"), "csf-17-50", "csf-25-100");
  EXPECT_TRUE(std::isinf(plant(another).motor.peak_torque_Nm));
}

TEST_F(SimulatedConfigTest, HasTheFrictionOfItsGearOfAnotherOrOfAFile) {
  const auto coulomb_Nm = [](const JointPlantConfig& joint) {
    return joint.joint.friction.at(20.0).coulomb_Nm;
  };
  const JointPlantConfig usual = plant(rigid_with(""));
  EXPECT_EQ(coulomb_Nm(plant(flexible_with(""))), coulomb_Nm(usual)) << "csf-17-50 is the reference joint's";
  EXPECT_EQ(coulomb_Nm(plant(rigid_with("", "friction = \"csf-17-50\"\n"))), coulomb_Nm(usual));
  const JointPlantConfig larger = plant(rigid_with("", "friction = \"csf-25-100\"\n"));
  EXPECT_GT(coulomb_Nm(larger), 2.0 * coulomb_Nm(usual));
  EXPECT_EQ(larger.joint.stribeck.velocity_rad_s, 0.5 * usual.joint.stribeck.velocity_rad_s);
  const JointPlantConfig twice = plant(rigid_with("", "friction = \"csf-25-100\"\nfriction_scale = 2\n"));
  EXPECT_DOUBLE_EQ(coulomb_Nm(twice), 2.0 * coulomb_Nm(larger));

  const std::string fitted = STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006-friction.json";
  const JointPlantConfig of_file = plant(rigid_with("", "friction = \"" + fitted + "\"\n"));
  EXPECT_NEAR(coulomb_Nm(of_file), coulomb_Nm(usual), 0.2 * coulomb_Nm(usual)) << "the same joint's";
  EXPECT_NE(coulomb_Nm(of_file), coulomb_Nm(usual));
  for (const char* wrong : {"csf-25-101", "none.json"})
    expect_mentions(error_of(rigid_with("", "friction = \"" + std::string(wrong) + "\"\n")),
                    {"joint[0].simulated.friction", wrong});
  expect_mentions(error_of(replaced(rigid_with("", "friction = \"" + fitted + "\"\n"), "gear_ratio = 50",
                                    "gear_ratio = 100")),
                  {"joint[0].simulated.friction", "gear_ratio", "must be the joint's, 100"});
}

TEST_F(SimulatedConfigTest, DiffersFromAFlexibleJointsModelOnlyInWhatIsSaid) {
  const JointPlantConfig other = plant(
      flexible_with("[joint.simulated.link]\ninertia_kgm2 = 0.2\n[joint.simulated.spring]\nscale = 0.5\n"));
  EXPECT_EQ(other.joint.inertia_kgm2, 0.089);
  EXPECT_EQ(other.effects.transmission->link_inertia_kgm2, 0.2);
  EXPECT_EQ(other.effects.transmission->spring.stiffness_1_Nm_rad, 4050.0);
  EXPECT_EQ(other.effects.transmission->damping_Nms_rad, 0.8);
  EXPECT_EQ(config_.joints.front().loop.controller.link->link_inertia_kgm2, 0.1)
      << "what the controller knows";
  EXPECT_EQ(plant(flexible_with("", "inertia_kgm2 = 0.05\n")).joint.inertia_kgm2, 0.05);
  expect_mentions(error_of(rigid_with(link(""), "gear = \"csf-17-50\"\n")),
                  {"joint[0].simulated.inertia_kgm2", "required"});
}

TEST_F(SimulatedConfigTest, RefusesToBeginBeyondThePositionLimits) {
  const auto beginning_at = [](const std::string& position, const std::string& keys = "") {
    return joint_with(link(""), "initial_position_rad = " + position + "\n" + keys);
  };
  EXPECT_NO_THROW(read(beginning_at("3.2")));
  const std::string refusal = error_of(beginning_at("90"));
  expect_mentions(refusal, {"joint[0].simulated.initial_position_rad = 90", "from -3.2 to 3.2 is allowed",
                            "position_max_rad", "if degrees are meant, write 1.5708"});
  EXPECT_EQ(error_of(beginning_at("-1000")).find("degrees"), std::string::npos) << "nor are they allowed";
  EXPECT_NO_THROW(read(beginning_at("90", "incremental = true\n"))) << "where it is it says after homing";
}

TEST_F(SimulatedConfigTest, TakesTheEncodersSideFromTheDriveUnlessAFlexibleJointSaysAnother) {
  const std::string fed_back = std::string(kEncoder) + "feedback = true\n";
  EXPECT_EQ(controller(flexible_with(kEncoder)).encoder_side, EncoderSide::kMotor)
      << "a second one beside it";
  EXPECT_EQ(controller(flexible_with(fed_back)).encoder_side, EncoderSide::kLink);
  EXPECT_EQ(controller(flexible_with(fed_back, "encoder_side = \"motor\"\n")).encoder_side,
            EncoderSide::kMotor)
      << "said wrongly, to see what it does";
  EXPECT_EQ(controller(joint_with(link(fed_back))).encoder_side, EncoderSide::kMotor)
      << "a rigid joint has none";
  expect_mentions(error_of(joint_with(link(fed_back), "encoder_side = \"motor\"\n")),
                  {"joint[0].simulated.encoder_side = \"motor\"", "joint.model = \"flexible\""});
}

TEST_F(SimulatedConfigTest, RefusesALinkEncoderWithoutItsResolution) {
  expect_mentions(error_of(joint_with(link("[joint.simulated.link_encoder]\nfeedback = false\n"))),
                  {"joint[0].simulated.link_encoder.counts_per_joint_revolution", "required"});
  expect_mentions(
      error_of(joint_with(link("[joint.simulated.link_encoder]\ncounts_per_joint_revolution = 0\n"))),
      {"joint[0].simulated.link_encoder.counts_per_joint_revolution = 0", "from 1"});
}

TEST_F(SimulatedConfigTest, RefusesGearsAndSpringsThatCannotBe) {
  expect_mentions(error_of(replaced(joint_with(link("")), "csf-17-50", "csf-18-50")),
                  {"joint[0].simulated.gear = \"csf-18-50\"", "csf-17-50"});
  expect_mentions(error_of(replaced(joint_with(link("")), "csf-17-50", "csf-17-100")),
                  {"joint[0].simulated.gear = \"csf-17-100\"", "ratio of 50"});
  expect_mentions(error_of(joint_with("")), {"joint[0].simulated.gear", "link.inertia_kgm2"});
  expect_mentions(error_of(joint_with(link("[joint.simulated.spring]\nstiffness_1_Nm_rad = -8100\n"))),
                  {"joint[0].simulated.spring.stiffness_1_Nm_rad = -8100", "from 1e-09"});
  expect_mentions(error_of(joint_with(link("[joint.simulated.spring]\nscale = 0\n"))),
                  {"joint[0].simulated.spring.scale = 0", "from 0.01"});
  expect_mentions(
      error_of(joint_with(link("[joint.simulated.spring]\ntorque_1_Nm = 20\ntorque_2_Nm = 10\n"))),
      {"joint[0].simulated.spring.torque_2_Nm = 10", "from 20"});
  // A slope that no torque reaches.
  const auto without_gear = [](const std::string& slope) {
    const std::string one_slope = link("[joint.simulated.spring]\nstiffness_1_Nm_rad = 8100\n" + slope);
    return replaced(joint_with(one_slope), "gear = \"csf-17-50\"\n", "");
  };
  expect_mentions(error_of(without_gear("stiffness_2_Nm_rad = 11000\n")),
                  {"joint[0].simulated.spring.stiffness_2_Nm_rad", "torque_1_Nm below torque_2_Nm"});
  expect_mentions(error_of(without_gear("stiffness_3_Nm_rad = 13000\n")),
                  {"joint[0].simulated.spring.stiffness_3_Nm_rad", "only with torque_2_Nm"});
  expect_mentions(error_of(joint_with("[joint.simulated.link]\ninertia_kgm2 = -0.1\n")),
                  {"joint[0].simulated.link.inertia_kgm2 = -0.1", "from"});
}

TEST_F(SimulatedConfigTest, TakesLoadsOverTime) {
  const auto load_Nm = [&](const std::string& text, double time_s) {
    config_ = read(joint_with(link(""), "load_torque_Nm = \"" + text + "\"\n"));
    return std::get<SimulatedDrive>(config_.joints.front().drive).actuator.load_torque_Nm.at(time_s);
  };
  EXPECT_EQ(load_Nm("steps:0,20,5,1", 4.999), 0.0);
  EXPECT_EQ(load_Nm("steps:0,20,5,1", 60.0), 20.0);
  EXPECT_DOUBLE_EQ(load_Nm("ramp:4,10,1,4", 2.0), 6.0);
  expect_mentions(error_of(joint_with(link(""), "load_torque_Nm = \"ramp:0,10,4,4\"\n")),
                  {"joint[0].simulated.load_torque_Nm", "end_s", "greater than begin_s"});
  expect_mentions(error_of(joint_with(link(""), "load_torque_Nm = \"constant:1e9\"\n")),
                  {"joint[0].simulated.load_torque_Nm", "1000"});
}

TEST_F(SimulatedConfigTest, FindsTheFilesOfProfilesBesideItselfWhereverItIsReadFrom) {
  std::ofstream(folder_ / "warm.csv") << "time_s,ambient_temperature_C\n0,31\n";
  std::ofstream(folder_ / "load.csv") << "time_s,load_torque_Nm\n0,7\n";
  const std::string profiled = replaced(rigid_with("", "load_torque_Nm = \"hold:load.csv\"\n"),
                                        "\"steps:-10,5,2,11\"", "\"csv:warm.csv\"");
  ASSERT_NE(std::filesystem::current_path(), folder_);
  const DaemonConfig config = read(profiled);
  const SimulatedActuatorConfig& drive = std::get<SimulatedDrive>(config.joints.front().drive).actuator;
  EXPECT_EQ(drive.ambient.at(1.0), 31.0);
  EXPECT_EQ(drive.load_torque_Nm.at(1.0), 7.0);
  expect_mentions(error_of(replaced(profiled, "warm.csv", "cold.csv")),
                  {"ambient_temperature_C", (folder_ / "cold.csv").c_str()});
}

}  // namespace
}  // namespace strainwave
