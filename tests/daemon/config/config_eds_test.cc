// SPDX-License-Identifier: BSD-3-Clause
// Checks the shipped examples against their vendors' data sheets. Start-up itself runs against the data sheets.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/text_file.h"
#include "control/table/gain_table_json.h"
#include "daemon/admission/table_admission.h"
#include "daemon/assembly.h"
#include "daemon/config/config.h"
#include "daemon/drive_check.h"
#include "tests/daemon/config/config_file_test.h"
#include "tests/support/example_keys.h"

namespace strainwave {
namespace {

class DataSheets : public ConfigFileTest {
 protected:
  DataSheets() { testing::write_authorized_keys(folder_); }
  static std::filesystem::path sheet(const std::string& name) {
    return std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "tests/drivers/can/eds" / name;
  }
  /// `eds` without the object's section.
  static std::string without(const std::string& eds, const std::string& index) {
    std::string kept;
    std::istringstream lines(eds);
    bool skips = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('[')) skips = line.starts_with("[" + index);
      if (!skips) kept += line + '\n';
    }
    return kept;
  }
  /// Messages of start-up for the first joint's drive.
  std::string check(const std::string& config, const std::string& eds) {
    std::ostringstream text;
    check_data_sheet(read(config), sheet(eds), text);
    return text.str();
  }
};

TEST_F(DataSheets, TheExampleForEpos4StartsADriveThatHasNo6072h) {
  const std::string text = check(example("epos4.toml"), "epos4.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  expect_mentions(text, {"mode 10 (CST)", "only this daemon limits the torque"});
}

TEST_F(DataSheets, ADriveThatClosesItsOwnLoopNeedsItsTargetAndNoTargetOfTorque) {
  const std::string eds = without(read_text_file(sheet("epos4.eds")), "6071");
  const auto check_with = [&](const std::string& sheet_text) {
    std::ofstream(folder_ / "drive.eds") << sheet_text;
    return check(example("epos4-position.toml"), folder_ / "drive.eds");
  };
  const std::string whole = check_with(eds);
  EXPECT_EQ(whole.find("refused"), std::string::npos) << whole;
  expect_mentions(whole, {"mode 8 (CSP)", "would accept"});
  expect_mentions(check_with(without(eds, "607A")), {"refused", "607Ah"});
  expect_mentions(check(example("epos4.toml"), folder_ / "drive.eds"), {"refused", "6071h"});
}

TEST_F(DataSheets, TheExampleForAStrainWaveActuatorStartsItsOwnDriveByInterpolatedPosition) {
  const std::string text = check(example("schunk-powerball.toml"), "schunk_powerball.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  expect_mentions(text, {"mode 7 (IP)", "no 6076h", "does not take 605Ah", "would accept"});
  expect_mentions(check(replaced(example("schunk-powerball.toml"), "drive_mode = \"position\"", ""),
                        "schunk_powerball.eds"),
                  {"refused", "CST (mode 10)", "drive_mode = \"position\" is possible"});
}

TEST_F(DataSheets, TheUnitOfVelocityIsComparedWithTheDrives) {
  expect_mentions(check(example("epos4-position.toml"), "epos4.eds"),
                  {"1 rev/min (60A9h = 00B44700h), at the motor"});
  expect_mentions(
      check(replaced(example("epos4-position.toml"), "= 0.0020943951", "= 0.020943951"), "epos4.eds"),
      {"refused", "velocity_rad_s_per_unit = 0.020943951", "00B44700h"});
}

TEST_F(DataSheets, TheExampleForElmoStartsAGoldDrive) {
  const std::string text = check(example("elmo.toml"), "elmo_gold.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  expect_mentions(text, {"mode 10 (CST)"});
}

TEST_F(DataSheets, TheExampleForAnEncoderOnTheLinkTakesItsTableAndNoneOfTheMotorsSide) {
  const std::string config = example("elmo-link.toml");
  const std::string text = check(config, "elmo_gold.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  const JointConfig joint = read(config).joints[0];
  EXPECT_EQ(joint.loop.controller.encoder_side, EncoderSide::kLink);
  // The package installs the table there.
  const std::filesystem::path tables = STRAINWAVE_SOURCE_DIR "/data/tables";
  ASSERT_TRUE(std::filesystem::exists(tables / joint.table.filename())) << joint.table;
  const auto judged = [&](const std::filesystem::path& name) {
    return judge_table(read_gain_table(tables / name), expected_joint(joint));
  };
  EXPECT_EQ(judged(joint.table.filename()).reason, Reason::kAccepted);
  EXPECT_EQ(judged("csf-17-50.json").reason, Reason::kTableIdentity);
}

TEST_F(DataSheets, TheExampleForElmoStartsASimpliqWithoutItsTemperature) {
  std::string config = example("elmo.toml");
  const std::size_t begin = config.find("[joint.can.temperature]");
  config.erase(begin, config.find("[[joint]]", begin) - begin);
  const std::string text = check(config, "elmo_simpliq.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  expect_mentions(text, {"mode 4 (TQ)"});
}

TEST_F(DataSheets, AnObjectThatCannotBeMappedIsRefusedByItsName) {
  const std::string text = check(
      replaced(example("elmo.toml"), "index = 0x22A2", "index = 0x22A3\nsub_index = 1"), "elmo_gold.eds");
  expect_mentions(text, {"refused", "elmo_gold.eds", "22A3h:01"});
}

TEST_F(DataSheets, AConfiguredDriveIsJudgedByWhatItIsSetTo) {
  // A DCF of an EPOS4 with node id 7: 6502h, 6076h and the vendor have the values read from the drive.
  std::string dcf = read_text_file(sheet("epos4.eds"));
  for (const auto& [object, value] :
       {std::pair{"[1018sub1]", "0xFB"}, {"[6502]", "0x3A5"}, {"[6076]", "192000"}})
    dcf = replaced(dcf, std::string(object) + "\n", std::string(object) + "\nParameterValue=" + value + "\n");
  std::ofstream(folder_ / "set.dcf") << "[DeviceComissioning]\nNodeID=7\n\n" << dcf;
  const auto check_with = [&](const std::string& config) { return check(config, folder_ / "set.dcf"); };
  const std::string right = check_with(example("epos4.toml"));
  EXPECT_EQ(right.find("refused"), std::string::npos) << right;
  expect_mentions(right, {"node_id = 1, but the data sheet is for node 7", "node 7, "});
  for (const char* known : {"6502h:00 has no value", "6076h:00 has no value", "1018h:01 has no value"})
    EXPECT_EQ(right.find(known), std::string::npos) << right;
  expect_mentions(check_with(replaced(example("epos4.toml"), "\"uNm\"", "\"mNm\"")),
                  {"refused", "\"uNm\"", "would agree"});
  expect_mentions(check_with(replaced(example("epos4.toml"), "0x000000FB", "0x9A")),
                  {"refused", "vendor_id"});
}

TEST_F(DataSheets, WhatTheyDoNotSayIsListedAsNotChecked) {
  const std::string text = check(example("epos4.toml"), "epos4.eds");
  expect_mentions(text, {"not checked: 6075h:00 has no value", "not checked: 6076h:00 has no value"});
}

TEST_F(DataSheets, ALimitThatExcludesWhatStartUpWritesIsNamedAndRefusesNothing) {
  expect_mentions(check(example("elmo.toml"), "elmo_gold.eds"),
                  {"1016h:01: start-up writes", "the data sheet's limits do not allow", "would accept"});
}

TEST_F(DataSheets, WhatIsUnclearMattersOnlyWhereStartUpLooks) {
  const std::string eds = read_text_file(sheet("epos4.eds"));
  std::ofstream(folder_ / "drive.eds") << replaced(eds, "[6064]\n", "[6064]\nAccessType=perhaps\n")
                                       << "\n[2099]\nDataType=long\nAccessType=ro\n";
  const std::string text = check(example("epos4.toml"), folder_ / "drive.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  EXPECT_EQ(text.find("2099h"), std::string::npos) << text;
  expect_mentions(text, {"not checked: 6064h:00 is unclear", "AccessType = 'perhaps'"});
}

TEST_F(DataSheets, AUnitThatTheMakerDoesNotUseIsDoubtedThoughTheConfigurationNamesNoMaker) {
  std::string config = replaced(example("epos4.toml"), "vendor_id = 0x000000FB", "");
  EXPECT_EQ(check(config, "epos4.eds").find("likely meant"), std::string::npos);
  config = replaced(config, "rated_torque_unit = \"uNm\"", "rated_torque_unit = \"mNm\"");
  expect_mentions(check(config, "epos4.eds"), {"warning: rated_torque_unit", "\"uNm\" is likely meant"});
}

TEST_F(DataSheets, AnotherVendorsDriveIsRefused) {
  expect_mentions(check(example("epos4.toml"), "elmo_gold.eds"), {"refused", "vendor_id", "0000009Ah"});
}

// The profile's objects for touch probe 1, except `lacks`.
std::string touch_probe(const std::string& lacks = "") {
  struct Object {
    const char* index;
    const char* type;
    const char* access;
  };
  std::string text;
  for (const auto& [index, type, access] :
       {Object{"60B8", "0x0006", "rww"}, {"60B9", "0x0006", "ro"}, {"60BA", "0x0004", "ro"}})
    if (index != lacks)
      text += std::string("\n[") + index + "]\nParameterName=Touch probe\nObjectType=0x7\nDataType=" + type +
              "\nAccessType=" + access + "\nPDOMapping=1\n";
  return text;
}

// The sections of the second transmit PDO, renumbered as those of the third.
std::string third_pdo(const std::string& eds) {
  std::string text;
  std::istringstream lines(eds);
  bool copies = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) copies = line.starts_with("[1801") || line.starts_with("[1A01");
    if (copies && line.starts_with('[')) line[4] = '2';
    if (copies) text += line + '\n';
  }
  return text;
}

TEST_F(DataSheets, HomingByTheEncodersIndexNeedsAllOfTheTouchProbe) {
  const std::string by_index =
      replaced(replaced(example("epos4.toml"), "to = \"limit\"", "to = \"index\""), "negative_limit = true",
               "index = \"encoder\"\nnegative_limit = true");
  const std::string epos4 = read_text_file(sheet("epos4.eds"));
  const auto check_with = [&](const std::string& objects) {
    std::ofstream(folder_ / "drive.eds") << epos4 << third_pdo(epos4) << objects;
    return check(by_index, folder_ / "drive.eds");
  };
  const std::string whole = check_with(touch_probe());
  EXPECT_EQ(whole.find("refused"), std::string::npos) << whole;
  for (const char* object : {"60B8", "60B9", "60BA"})
    expect_mentions(check_with(touch_probe(object)), {"refused", "drive.eds", object});
}

TEST_F(DataSheets, ExamplesAcceptTheShippedTable) {
  for (const char* name : {"epos4.toml", "elmo.toml", "odrive.toml"})
    for (const JointConfig& joint : read(example(name)).joints)
      EXPECT_GE(joint.loop.controller.torque_limit_Nm, 34.0) << name;
}

}  // namespace
}  // namespace strainwave
