// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config.h"

#include <fstream>
#include <string>

#include "control/table/gain_table_json.h"
#include "daemon/admission/table_admission.h"
#include "daemon/assembly.h"
#include "tests/daemon/config/config_file_test.h"
#include "tests/support/example_keys.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

constexpr const char* kSound = R"([daemon]
period_s = 0.001
prefix = "LAB"

[security]
unsigned_orders = "allow"

[[joint]]
name = "elbow"
joint_model = "rhs17-6006"
model = "rigid"
inertia_kgm2 = 0.089
gear_ratio = 50
driver = "simulated"
[joint.limits]
position_min_rad = -3.2
position_max_rad = 3.2
speed_limit_rad_s = 6.0
acceleration_rad_s2 = 150
following_error_rad = 0.1
torque_limit_Nm = 34
[joint.simulated]
ambient_temperature_C = "sine:15,25,1"
)";

class ConfigTest : public ConfigFileTest {
 protected:
  /// The message for kSound with `from` replaced by `to`.
  std::string error_after(const std::string& from, const std::string& to) {
    return error_of(replaced(kSound, from, to));
  }
};

TEST_F(ConfigTest, ReadsASoundFile) {
  const DaemonConfig config = read(kSound);
  EXPECT_EQ(config.prefix, "LAB");
  ASSERT_EQ(config.joints.size(), 1U);
  EXPECT_EQ(config.joints[0].plant.inertia_kgm2, 0.089);
  EXPECT_NE(assemble_loop(config).joints[0].actuator, nullptr);
  EXPECT_EQ(assemble_admission(config)[0].position_max_rad, 3.2);
}

TEST_F(ConfigTest, NamesFileLineKeyAndTheUnitThatWasForgotten) {
  expect_mentions(error_after("period_s", "period"), {"c.toml:2", "daemon.period", "did you mean period_s"});
}

TEST_F(ConfigTest, NamesKeyValueAndRangeOfAnImpossibleValue) {
  expect_mentions(error_after("inertia_kgm2 = 0.089", "inertia_kgm2 = -1"),
                  {"joint[0].inertia_kgm2 = -1", "from"});
  expect_mentions(error_after("torque_limit_Nm = 34", "torque_limit_Nm = nan"), {"torque_limit_Nm = nan"});
  expect_mentions(error_after("speed_limit_rad_s = 6.0", "speed_limit_rad_s = \"fast\""),
                  {"speed_limit_rad_s", "fast", "a number"});
}

TEST_F(ConfigTest, NamesAMissingKey) {
  expect_mentions(error_after("gear_ratio = 50\n", ""), {"joint[0].gear_ratio is missing"});
}

TEST_F(ConfigTest, SuggestsTheNearestKeyForAMisspelledOne) {
  expect_mentions(error_after("following_error_rad", "folowing_error_rad"),
                  {"following_error_rad is missing"});
  expect_mentions(error_after("driver = \"simulated\"", "driver = \"simulated\"\ndrivr = 1"),
                  {"drivr", "did you mean driver"});
}

TEST_F(ConfigTest, ListsTheDriversWhenOneIsUnknown) {
  expect_mentions(error_after("\"simulated\"", "\"warp\""), {"driver", "warp", "simulated"});
}

TEST_F(ConfigTest, RefusesLimitsThatCross) {
  expect_mentions(error_after("position_max_rad = 3.2", "position_max_rad = -4"),
                  {"position_max_rad", "above position_min_rad"});
}

TEST_F(ConfigTest, RefusesATemperatureLimitThatNoBelievableReadingReaches) {
  for (const char* limit : {"90", "95"})
    expect_mentions(error_after("torque_limit_Nm = 34",
                                std::string("torque_limit_Nm = 34\ntemperature_limit_C = ") + limit),
                    {"joint[0].temperature.max_C", "joint.limits.temperature_limit_C"});
  EXPECT_NO_THROW(
      read(replaced(kSound, "torque_limit_Nm = 34", "torque_limit_Nm = 34\ntemperature_limit_C = 89")));
}

TEST_F(ConfigTest, DeratesTenDegreesBelowTheTemperatureLimitAndAtLeastOne) {
  EXPECT_EQ(read(kSound).joints.at(0).loop.limits.derating_C, 70.0);
  expect_mentions(error_after("torque_limit_Nm = 34", "torque_limit_Nm = 34\nderating_C = 79.5"),
                  {"derating_C = 79.5", "to 79"});
}

TEST_F(ConfigTest, MovesAtAQuarterOfTheSpeedLimitUnlessToldAndHasNoJerkLimitByItself) {
  const auto limits = [](const std::string& keys) {
    return replaced(kSound, "torque_limit_Nm = 34", "torque_limit_Nm = 34\n" + keys);
  };
  const JointLoopConfig loop = read(kSound).joints[0].loop;
  EXPECT_EQ(loop.move_speed_share, 0.25);
  EXPECT_FALSE(loop.controller.jerk_limit_rad_s3.has_value());
  EXPECT_EQ(read(limits("move_speed_share = 1")).joints[0].loop.move_speed_share, 1.0);
  EXPECT_EQ(read(limits("jerk_limit_rad_s3 = 5000")).joints[0].loop.controller.jerk_limit_rad_s3, 5000.0);
  expect_mentions(error_of(limits("move_speed_share = 1.1")), {"move_speed_share = 1.1", "1"});
  expect_mentions(error_of(limits("jerk_limit_rad_s3 = 0")), {"jerk_limit_rad_s3 = 0"});
}

TEST_F(ConfigTest, SaysWhenALoadIsHighAndHowTheJointYields) {
  const auto limits = [](const std::string& keys) {
    return replaced(kSound, "torque_limit_Nm = 34", "torque_limit_Nm = 34\n" + keys);
  };
  const JointLoopConfig loop = read(limits("load_Nm = 20")).joints[0].loop;
  EXPECT_EQ(loop.limits.load.under(34.0).notice_Nm, 16.0);
  EXPECT_EQ(loop.overload_stop, OverloadStop::kTorqueOff);
  EXPECT_EQ(read(limits("on_overload = \"hold_load\"")).joints[0].loop.overload_stop,
            OverloadStop::kHoldLoad);
  expect_mentions(error_of(limits("load_Nm = 20\nload_notice_Nm = 21")), {"load_notice_Nm = 21", "20"});
}

TEST_F(ConfigTest, AllowsNoStallLimitWithinWhichNoPeriodCanBeMissed) {
  expect_mentions(error_after("period_s = 0.001", "period_s = 0.001\nstall_limit_s = 0.001"),
                  {"daemon.stall_limit_s"});
  EXPECT_EQ(
      read(replaced(kSound, "period_s = 0.001", "period_s = 0.02\nstate_rate_Hz = 40")).loop.overruns.stall_s,
      0.04)
      << "by default at least two periods";
}

TEST_F(ConfigTest, RefusesTwoJointsOfTheSameName) {
  std::string text = kSound;
  text += std::string(kSound).substr(std::string(kSound).find("[[joint]]"));
  EXPECT_THROW(read(text), InputError);
}

TEST_F(ConfigTest, RefusesABadTemperatureProfileWithTheProfilesOwnReason) {
  expect_mentions(error_after("sine:15,25,1", "sine:15"), {"ambient_temperature_C", "sine"});
}

TEST_F(ConfigTest, NamesTheLineOfMalformedToml) {
  expect_mentions(error_after("prefix = \"LAB\"", "prefix = LAB"), {"c.toml:3", "not valid TOML"});
}

TEST_F(ConfigTest, NamesADecimalCommaAndTakesNoOtherCommaForOne) {
  expect_mentions(error_after("inertia_kgm2 = 0.089", "inertia_kgm2 = 0,089"),
                  {"c.toml:", "decimal point", "0.5, not 0,5"});
  EXPECT_EQ(error_after("prefix = \"LAB\"", "prefix = LAB # 1,2").find("decimal"), std::string::npos);
}

TEST_F(ConfigTest, ConvertsFromUnitsThatAreNotUsedHere) {
  expect_mentions(error_after("torque_limit_Nm = 34", "torque_limit_kgfm = 3.5"),
                  {"torque_limit_Nm is missing", "torque_limit_kgfm", "9.81 N m"});
  expect_mentions(error_after("torque_limit_Nm = 34", "torque_limit_Nm = 34\ntemperature_limit_F = 158"),
                  {"temperature_limit_F", "temperature_limit_C", "(degF - 32) / 1.8"});
}

TEST_F(ConfigTest, SaysEveryErrorOfTheFileAtOnceEachInALine) {
  std::string text = kSound;
  const std::string second = text.substr(text.find("[[joint]]"));
  text = text.replace(text.find("prefix = \"LAB\""), 14, "prefix = \"LAB\"\nstate_rate_Hz = 0\ncolour = 1") +
         second;
  const auto spoil = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.rfind(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  spoil("inertia_kgm2 = 0.089", "inertia_kgm = 0.089");
  spoil("driver = \"simulated\"", "driver = \"simulate\"");
  spoil("gear_ratio = 50", "gear_ratio = \"50\"");
  const std::string error = error_of(text);
  expect_mentions(error, {"daemon.state_rate_Hz = 0", "joint[1].inertia_kgm2 is missing",
                          "inertia_kgm: is that what was meant", "joint[1].driver = \"simulate\"",
                          "joint[1].gear_ratio", "without quotes", "daemon.colour"});
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 4) << error;
}

TEST_F(ConfigTest, NamesAFileThatCannotBeRead) {
  const std::string refused = testing::refusal_of([&] { read_config(folder_ / "absent.toml"); });
  expect_mentions(refused, {"absent.toml", "cannot be read"});
}

TEST_F(ConfigTest, ObeysNobodyWithoutKeysUnlessToldTo) {
  expect_mentions(error_after("unsigned_orders = \"allow\"", ""),
                  {"security.authorized_keys is missing", "keygen", "unsigned_orders"});
  expect_mentions(error_after("\"allow\"", "\"maybe\""), {"security.unsigned_orders", "maybe", "refuse"});
}

TEST_F(ConfigTest, ReadsTheKeysBesideTheConfiguration) {
  const PublicKey key = SecretKey::generate().public_key();
  std::ofstream(folder_ / "keys") << to_line(AuthorizedKey{key, Role::kEngineer, "Emma"}) << '\n';
  std::string text = kSound;
  text.replace(text.find("unsigned_orders = \"allow\""), 25, "authorized_keys = \"keys\"");
  const DaemonConfig config = read(text);
  EXPECT_FALSE(config.security.unsigned_allowed);
  EXPECT_EQ(config.security.keys[0].key, key);
}

TEST_F(ConfigTest, RefusesAGatewayUserWhoIsNoneOrRoot) {
  expect_mentions(error_after("prefix = \"LAB\"", "gateway_user = \"nobody-such\""),
                  {"daemon.gateway_user", "no such user"});
  expect_mentions(error_after("prefix = \"LAB\"", "gateway_user = \"root\""),
                  {"daemon.gateway_user", "without privileges"});
}

TEST_F(ConfigTest, EveryShippedExampleIsSoundAndTakesTheTableThatItNames) {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(STRAINWAVE_SOURCE_DIR "/config")) {
    if (entry.path().extension() != ".toml") continue;
    // A copy beside the keys that a real joint needs.
    std::filesystem::copy_file(entry.path(), folder_ / entry.path().filename());
    testing::write_authorized_keys(folder_);
    const DaemonConfig config = read_config(folder_ / entry.path().filename());
    ++found;
    for (const JointConfig& joint : config.joints) {
      if (joint.table.empty()) continue;
      // The package installs the source tree's folder data/tables.
      const std::string named = joint.table;
      const std::string file = STRAINWAVE_SOURCE_DIR + named.substr(named.find("/data/tables/"));
      const TableVerdict verdict = judge_table(read_gain_table(file), expected_joint(joint));
      EXPECT_EQ(verdict.reason, Reason::kAccepted) << entry.path() << ": " << verdict.text;
    }
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace strainwave
