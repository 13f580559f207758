// SPDX-License-Identifier: BSD-3-Clause
// [joint.gpio], [joint.homing] and [joint.thermometer]: the example is valid, and impossible values are
// refused by name.

#include <sstream>

#include "base/text_file.h"
#include "daemon/config/config.h"
#include "daemon/drive_check.h"
#include "tests/daemon/config/config_file_test.h"
#include "tests/support/example_keys.h"

namespace strainwave {
namespace {

class GpioConfig : public ConfigFileTest {
 protected:
  GpioConfig() { testing::write_authorized_keys(folder_); }
  std::string replaced(const std::string& from, const std::string& to) const {
    return ConfigFileTest::replaced(example_, from, to);
  }
  /// The example without the table [name] and its keys.
  std::string without(const std::string& name) const {
    const std::size_t begin = example_.find("[" + name + "]");
    EXPECT_NE(begin, std::string::npos) << name;
    const std::size_t end = example_.find("\n[", begin);
    return example_.substr(0, begin) + (end == std::string::npos ? "" : example_.substr(end + 1));
  }
  void expect_refused(const std::string& text, std::initializer_list<const char*> parts) {
    expect_mentions(error_of(text), parts);
  }

  std::string example_ = example("gpio.toml");
};

TEST_F(GpioConfig, OfTheExampleIsSoundAndTellsTheControllerWhatTheDatasheetSays) {
  const DaemonConfig config = read(example_);
  ASSERT_EQ(config.joints.size(), 1U);
  const JointControllerConfig& controller = config.joints[0].loop.controller;
  EXPECT_NEAR(controller.motor.peak_torque_Nm, 4.3 * 9.6, 1e-9);
  EXPECT_NEAR(controller.motor.stall_torque_Nm, 9.6 * 75.0 / 4.8, 1e-9);
  EXPECT_NEAR(controller.encoder_resolution_rad, 2.0 * 3.14159265358979 / 320000.0, 1e-12);
  const HomingConfig& homing = config.joints[0].loop.homing;
  EXPECT_EQ(homing.target, HomingTarget::kHomeSwitch);
  EXPECT_TRUE(homing.required);
  EXPECT_TRUE(homing.then_index);
  ASSERT_TRUE(config.joints[0].thermometer);
  EXPECT_EQ(config.joints[0].thermometer->kind, TemperatureFileKind::kOneWire);
  EXPECT_FALSE(config.joints[0].driver_resource.empty()) << "two daemons must not share a motor";
}

TEST_F(GpioConfig, IsReadWithoutTheHardware) {
  const DaemonConfig config = read(example_);
  std::ostringstream lines;
  EXPECT_FALSE(check_lines(config, lines)) << "this machine is no such board";
  EXPECT_NE(lines.str().find("estop"), std::string::npos);
  EXPECT_NE(lines.str().find("MISSING"), std::string::npos) << lines.str();
  EXPECT_THROW((void)assemble_loop(config), InputError) << "before anything moves";
}

TEST_F(GpioConfig, NeedsADirectionLineExactlyForSignMagnitude) {
  expect_refused(without("joint.gpio.direction"), {"bridge", "direction"});
  expect_refused(replaced("bridge = \"sign_magnitude\"", "bridge = \"locked_antiphase\""), {"bridge"});
}

TEST_F(GpioConfig, RefusesMoreTorqueThanTheMotorMayHave) {
  expect_refused(replaced("torque_limit_Nm = 34", "torque_limit_Nm = 45"),
                 {"joint[0].gpio.motor", "41.28", "torque_limit_Nm"});
}

TEST_F(GpioConfig, RefusesASpeedThatEdgesCannotFollow) {
  std::string text =
      replaced("source = \"counter\"\ncounter = \"counter2/count0\"    # eQEP2\nceiling = 4294967295",
               "source = \"edges\"");
  expect_refused(text, {"quadrature_a"});
  for (const char* line : {"quadrature_a", "quadrature_b"})
    text += std::string("\n[joint.gpio.") + line + "]\nchip = \"gpiochip0\"\nline = \"" + line + "\"\n";
  expect_refused(text, {"joint[0].gpio.encoder.source", "speed_limit_rad_s", "edges"});
}

TEST_F(GpioConfig, RefusesACeilingThatOnePeriodCouldWrap) {
  expect_refused(replaced("ceiling = 4294967295", "ceiling = 500"), {"ceiling", "500"});
}

TEST_F(GpioConfig, RefusesBrakeDelaysWithoutABrake) {
  expect_refused(without("joint.gpio.brake_release"), {"release_delay_s", "brake_release"});
}

TEST_F(GpioConfig, HomesOnlyToWhatIsThere) {
  expect_refused(without("joint.gpio.home"), {"joint[0].homing.to", "home switch"});
  expect_refused(without("joint.gpio.index"), {"then_index"});
  expect_refused(replaced("to = \"home\"", "to = \"none\""), {"required"});
  expect_refused(replaced("position_rad = 0.0", "position_rad = 2.0"), {"joint[0].homing.position_rad"});
}

TEST_F(GpioConfig, WantsVoltagesDataForAVoltage) {
  expect_refused(replaced("kind = \"current\"", "kind = \"voltage\""), {"full_scale_A"});
  std::string text = replaced("kind = \"current\"", "kind = \"voltage\"");
  text.replace(text.find("full_scale_A = 5.0 "), 19, "# ");
  EXPECT_NO_THROW(read(text));
  text.replace(text.find("resistance_ohm = 4.8"), 20, "# ");
  expect_refused(text, {"resistance_ohm"});
}

TEST_F(GpioConfig, NeverMovesForAnybodyWhoAsks) {
  expect_refused(replaced("authorized_keys = \"authorized_keys\"", "unsigned_orders = \"allow\""),
                 {"unsigned_orders"});
}

TEST_F(GpioConfig, RefusesAThermometerForTheSimulatedJoint) {
  expect_refused(read_text_file(STRAINWAVE_SOURCE_DIR "/config/demo.toml") +
                     "\n[joint.thermometer]\nfile = \"/sys/x\"\n",
                 {"thermometer"});
}

}  // namespace
}  // namespace strainwave
