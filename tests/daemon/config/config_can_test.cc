// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "daemon/assembly.h"
#include "daemon/config/config.h"
#include "tests/daemon/config/config_file_test.h"
#include "tests/support/example_keys.h"

namespace strainwave {
namespace {

class CanConfigTest : public ConfigFileTest {
 protected:
  CanConfigTest() { testing::write_authorized_keys(folder_); }
  std::string error_after(const std::string& name, const std::string& from, const std::string& to) {
    return error_of(replaced(example(name), from, to));
  }
};

TEST_F(CanConfigTest, PutsJointsOnTheirBusAndKeepsOtherDaemonsOffTheirNodes) {
  const DaemonConfig config = read(example("elmo.toml"));
  ASSERT_EQ(config.buses.size(), 1U);
  EXPECT_EQ(config.buses[0].name, "arm");
  ASSERT_EQ(config.joints.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& place = std::get<DriveOnBus>(config.joints[i].drive);
    EXPECT_EQ(place.bus, 0U);
    EXPECT_EQ(place.slot, i);
    EXPECT_EQ(config.joints[i].driver_resource, "can0 node " + std::to_string(i + 1));
    ASSERT_NE(config.joints[i].drive_error_text, nullptr);
  }
}

TEST_F(CanConfigTest, TellsTheControllerTheEncoderTheDelayAndWhatTheSupplyLeaves) {
  const JointControllerConfig controller = read(example("epos4.toml")).joints[0].loop.controller;
  EXPECT_NEAR(controller.encoder_resolution_rad, 2 * std::numbers::pi / 320000, 1e-15);
  EXPECT_EQ(controller.delay_periods, 1);
  EXPECT_NEAR(controller.motor.stall_torque_Nm, 9.6 * 48 / 4.8, 1e-9);
  EXPECT_NEAR(controller.motor.torque_per_speed_Nms_rad, 9.6 * 9.6 / 4.8, 1e-9);
}

TEST_F(CanConfigTest, WantsAnIncrementalEncoderToBeHomed) {
  const HomingConfig homing = read(example("epos4.toml")).joints[0].loop.homing;
  EXPECT_TRUE(homing.required) << "without its being said";
  EXPECT_EQ(homing.target, HomingTarget::kLimitSwitch);
  EXPECT_EQ(homing.direction, -1.0);
  expect_mentions(error_after("epos4.toml", "to = \"limit\"", "to = \"none\""),
                  {"joint[0].homing.to", "incremental"});
  expect_mentions(error_after("epos4.toml", "to = \"limit\"", "to = \"limit\"\nrequired = false"),
                  {"joint[0].homing.required", "incremental"});
  expect_mentions(error_after("epos4.toml", "to = \"limit\"", "to = \"home\""), {"no home switch"});
  expect_mentions(error_after("epos4.toml", "encoder = \"incremental\"", ""),
                  {"joint[0].can.encoder", "required"});
  EXPECT_FALSE(read(example("elmo.toml")).joints[0].loop.homing.required) << "absolute";
}

TEST_F(CanConfigTest, HomesByTheIndexOfADriveWhoseTouchProbeMayBeUsed) {
  const std::string by_index =
      replaced(example("epos4.toml"), "to = \"limit\"", "to = \"limit\"\nthen_index = true");
  expect_mentions(error_of(by_index), {"joint[0].homing.then_index", "an index input"});
  const DaemonConfig config =
      read(replaced(by_index, "positive_limit = true", "positive_limit = true\nindex = \"encoder\""));
  EXPECT_TRUE(config.joints[0].loop.homing.then_index);
  const auto& drive = std::get<cia402::DriveConfig>(config.buses[0].drives[0]);
  EXPECT_EQ(drive.inputs.index, cia402::ProbeSource::kIndex);
  expect_mentions(
      error_after("epos4.toml", "positive_limit = true", "positive_limit = true\nindex = \"encodr\""),
      {"joint[0].can.inputs.index = \"encodr\"", "did you mean \"encoder\""});
}

TEST_F(CanConfigTest, WantsTheTorqueThatTellsAMechanicalStop) {
  const HomingConfig homing = read(example("odrive.toml")).joints[0].loop.homing;
  EXPECT_EQ(homing.target, HomingTarget::kStop);
  EXPECT_EQ(homing.stop_torque_Nm, 12.0);
  expect_mentions(error_after("odrive.toml", "stop_torque_Nm = 12", ""), {"stop_torque_Nm", "required"});
}

TEST_F(CanConfigTest, RefusesNodesThatCollide) {
  expect_mentions(error_after("elmo.toml", "node_id = 2", "node_id = 1"),
                  {"joint[1].can.node_id", "of its own"});
  expect_mentions(error_after("elmo.toml", "node_id = 2", "node_id = 127"), {"node_id", "our_node_id"});
  expect_mentions(error_after("elmo.toml", "node_id = 2", "node_id = 128"), {"node_id", "1 to 127"});
  expect_mentions(error_after("elmo.toml", "node_id = 2\n", ""), {"node_id", "required"});
}

TEST_F(CanConfigTest, RefusesABusThatNobodyNamedOrUses) {
  expect_mentions(error_after("epos4.toml", "bus = \"arm\"", "bus = \"leg\""),
                  {"can.bus", "leg", "[[can_bus]]"});
  const std::string other = "[[can_bus]]\nname = \"leg\"\ninterface = \"can1\"\n\n[[can_bus]]";
  expect_mentions(error_after("epos4.toml", "[[can_bus]]", other), {"can_bus[0].name", "at least one joint"});
  const std::string same = "[[can_bus]]\nname = \"leg\"\ninterface = \"can0\"\n\n[[can_bus]]";
  expect_mentions(error_after("epos4.toml", "[[can_bus]]", same), {"interface of its own"});
}

TEST_F(CanConfigTest, RefusesABusThatWouldBeTooFull) {
  expect_mentions(error_after("elmo.toml", "bit_rate = 1000000", "bit_rate = 250000"),
                  {"arm:", "% of 250000 bit/s", "load_limit", "RPDO1 of elbow"});
}

TEST_F(CanConfigTest, WantsUnitAndSideOfTorqueSaid) {
  expect_mentions(error_after("epos4.toml", "rated_torque_unit = \"uNm\"", ""),
                  {"rated_torque_unit", "required"});
  expect_mentions(error_after("epos4.toml", "torque_side = \"motor\"", ""), {"torque_side", "required"});
  expect_mentions(error_after("epos4.toml", "\"uNm\"", "\"Nm\""), {"rated_torque_unit", "mNm", "uNm"});
}

TEST_F(CanConfigTest, TakesOneTemperaturePerJoint) {
  const std::string sensor = "[joint.thermometer]\nfile = \"/dev/null\"\n\n[joint.can]";
  expect_mentions(error_after("epos4.toml", "[joint.can]", sensor),
                  {"joint[0].thermometer", "one temperature"});
  std::string text = example("epos4.toml");
  text.replace(text.find("[joint.can]"), 11, sensor);
  text.resize(text.find("[joint.can.temperature]"));
  EXPECT_TRUE(read(text).joints[0].thermometer.has_value());
}

TEST_F(CanConfigTest, WantsTheEncodersSideOfAFlexibleJointAndRefusesItOfARigidOne) {
  expect_mentions(error_after("epos4.toml", "encoder_side = \"motor\"", ""),
                  {"joint[0].can.encoder_side", "required"});
  const std::string on_the_link =
      replaced(example("epos4.toml"), "encoder_side = \"motor\"", "encoder_side = \"link\"");
  EXPECT_EQ(read(on_the_link).joints[0].loop.controller.encoder_side, EncoderSide::kLink);
  std::string rigid = example("epos4.toml");
  const std::size_t model = rigid.find("model = \"flexible\"");
  rigid.replace(model, rigid.find("driver = ") - model, "model = \"rigid\"\ninertia_kgm2 = 0.089\n");
  expect_mentions(error_of(rigid),
                  {"joint[0].can.encoder_side = \"motor\"", "joint.model = \"flexible\"", "no sides"});
  EXPECT_NO_THROW(read(replaced(rigid, "encoder_side = \"motor\"", "")));
}

TEST_F(CanConfigTest, LetsOneDriveMakeTheSyncWhenTheBusSaysSo) {
  expect_mentions(
      error_after("epos4.toml", "protocol = \"cia402\"", "protocol = \"cia402\"\nproduces_sync = true"),
      {"produces_sync", "sync = \"drive\""});
  expect_mentions(error_after("epos4.toml", "bit_rate = 1000000\n", "sync = \"drive\"\n"),
                  {"can_bus[0].sync", "produces_sync"});
  std::string text = example("epos4.toml");
  text.replace(text.find("bit_rate = 1000000\n"), 19, "sync = \"drive\"\n");
  text.replace(text.find("protocol = \"cia402\""), 19, "protocol = \"cia402\"\nproduces_sync = true");
  EXPECT_NO_THROW(read(text));
}

TEST_F(CanConfigTest, SaysWhatIsWrongWithTheInterfaceBeforeAnythingIsSent) {
  const DaemonConfig config = read(example("epos4.toml"));
  try {
    (void)assemble_bus(config.buses[0]);
    GTEST_SKIP() << "this machine has a can0 with the example's drive";
  } catch (const InputError& error) {
    expect_mentions(error.what(), {"can0", "no such interface"});
  }
}

TEST_F(CanConfigTest, WarnsOfNumbersThatContradictEachOtherWithTheValueThatIsLikelyMeant) {
  struct Row {
    const char* from;
    const char* to;
    std::initializer_list<const char*> parts;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"= 320000", "= 6400", {"counts_per_output_revolution = 6400", "128", "write 320000"}},
           {"supply_V = 48", "supply_V = 4.8", {"supply_V = 4.8", "38.4 V", "supply_V = 48"}},
           {"torque_constant_Nm_A = 0.192",
            "torque_constant_Nm_A = 9.6",
            {"480 N.m", "34", "the motor's is 0.192"}},
           {"rated_torque_unit",
            "velocity_rad_s_per_unit = 0.10472\nrated_torque_unit",
            {"velocity_rad_s_per_unit = 0.10472", "rpm of the motor 0.00209"}},
           {"\"uNm\"", "\"mNm\"", {"rated_torque_unit", "maxon", "\"uNm\" is likely meant"}},
           {"motor_inertia_kgm2 = 0.089",
            "motor_inertia_kgm2 = 8.9",
            {"motor_inertia_kgm2 = 8.9", "3.778 rad/s2", "is 0.089 meant?"}},
           {"temperature_limit_C = 70",
            "temperature_limit_C = 158",
            {"temperature_limit_C", "Fahrenheit", "write 70"}}}) {
    std::string text = replaced(example("epos4.toml"), row.from, row.to);
    if (std::string(row.to).find("158") != std::string::npos)
      text = replaced(text, "[joint.homing]", "[joint.temperature]\nmax_C = 200\n[joint.homing]");
    const std::vector<std::string> warnings = read(text).warnings;
    std::string all;
    for (const std::string& warning : warnings) all += warning + '\n';
    expect_mentions(all, row.parts);
  }
}

TEST_F(CanConfigTest, ANodeIdThatCannotBeHidesNoOtherErrorAndNoErrorIsSaidTwice) {
  const std::string error = error_of(replaced(replaced(example("epos4.toml"), "node_id = 1", "node_id = 200"),
                                              "supply_V = 48", "supply_V = -48"));
  expect_mentions(error, {"node_id = 200", "from 1 to 127", "supply_V = -48"});
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
}

TEST_F(CanConfigTest, ALimitInFahrenheitIsNamedThoughItIsAboveWhatIsBelieved) {
  expect_mentions(error_after("epos4.toml", "temperature_limit_C = 70", "temperature_limit_C = 158"),
                  {"temperature_limit_C = 158", "Fahrenheit", "write 70"});
}

TEST_F(CanConfigTest, DoubtsNoUnitOfVelocityThatDrivesHave) {
  // Counts per second; 1 rpm, 0.1 rpm and a millionth of a rpm of the motor (60A9h).
  for (const char* unit : {"1.9635e-5", "0.0020944", "2.0944e-4", "2.09440e-9"})
    for (const std::string& warning :
         read(replaced(example("epos4.toml"), "rated_torque_unit",
                       std::string("velocity_rad_s_per_unit = ") + unit + "\nrated_torque_unit"))
             .warnings)
      EXPECT_EQ(warning.find("velocity_rad_s_per_unit"), std::string::npos) << warning;
}

TEST_F(CanConfigTest, ADriveMayCloseItsOwnLoopWhereNothingElseContradicts) {
  EXPECT_EQ(read(example("epos4.toml")).joints[0].loop.controller.drive_mode, DriveMode::kTorque);
  const DaemonConfig config = read(example("epos4-position.toml"));
  EXPECT_EQ(config.joints[0].loop.controller.drive_mode, DriveMode::kPosition);
  EXPECT_FALSE(expected_joint(config.joints[0]).law_acts);
  const auto& drive = std::get<cia402::DriveConfig>(config.buses[0].drives[0]);
  EXPECT_EQ(drive.drive_mode, DriveMode::kPosition);
  EXPECT_EQ(drive.following_error_rad, 0.1);
  EXPECT_NEAR(drive.units.velocity_rad_s_per_unit, 2 * std::numbers::pi / 60 / 50, 1e-9)
      << "rpm of the motor";
  for (const auto& [from, to, part] :
       {std::tuple{"\"position\" ", "\"speed\" ", "drive_mode = \"speed\""},
        {"encoder_side = \"motor\"", "encoder_side = \"link\"", "encoder_side"},
        {"torque_limit_Nm = 34", "torque_limit_Nm = 34\non_overload = \"hold_load\"", "on_overload"}})
    expect_mentions(error_after("epos4-position.toml", from, to), {"joint[0].can.drive_mode", part});
  EXPECT_EQ(config.joints[0].loop.controller.drive_loop_period_s, 0.0004);
  EXPECT_EQ(read(example("schunk-powerball.toml")).joints[0].loop.controller.drive_loop_period_s, 0.00025);
  expect_mentions(error_after("epos4-position.toml", "= 0.0004", "= 0.0011"),
                  {"joint[0].can.drive_loop_period_s", "0.0011", "0 to 0.001"});
  std::string by_velocity = replaced(example("epos4-position.toml"), "\"position\" ", "\"velocity\" ");
  expect_mentions(error_of(by_velocity), {"drive_loop_period_s", "only with drive_mode = \"position\""});
  by_velocity = replaced(by_velocity, "drive_loop_period_s = 0.0004", "");
  EXPECT_EQ(read(by_velocity).joints[0].loop.controller.drive_loop_period_s, 0.0);
  expect_mentions(error_of(replaced(by_velocity, "velocity_rad_s_per_unit = 0.0020943951", "")),
                  {"joint[0].can.drive_mode", "velocity_rad_s_per_unit"});
}

TEST_F(CanConfigTest, HasNoDoubtsAboutTheShippedExamples) {
  for (const char* name : {"epos4.toml", "epos4-position.toml", "elmo.toml", "elmo-link.toml", "odrive.toml",
                           "schunk-powerball.toml"})
    for (const std::string& warning : read(example(name)).warnings)
      EXPECT_NE(warning.find("a real joint needs this"), std::string::npos) << name << ": " << warning;
}

TEST_F(CanConfigTest, AGearOfAnotherRatioIsRefusedWithItsOwn) {
  expect_mentions(error_after("elmo-link.toml", "gear_ratio = 50", "gear_ratio = 100"),
                  {"gear_ratio = 100", "is 50", "correct joint.gear_ratio"});
}

TEST_F(CanConfigTest, ChecksOfDrivesNeedNoKeys) {
  std::filesystem::remove(folder_ / "authorized_keys");
  expect_mentions(error_of(example("epos4.toml")), {"authorized_keys"});
  EXPECT_NO_THROW(read_config(folder_ / "c.toml", ConfigUse::kCheckDrives));
}

}  // namespace
}  // namespace strainwave
