// The shipped examples against what their vendors' drives have: start-up itself is run against the data sheets.
#include <gtest/gtest.h>

#include <sstream>

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
  /// What start-up would say of the first joint's drive.
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

TEST_F(DataSheets, TheExampleForElmoStartsAGoldDrive) {
  const std::string text = check(example("elmo.toml"), "elmo_gold.eds");
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
  expect_mentions(text, {"mode 10 (CST)"});
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

TEST_F(DataSheets, AnotherVendorsDriveIsRefused) {
  expect_mentions(check(example("epos4.toml"), "elmo_gold.eds"), {"refused", "vendor_id", "0000009Ah"});
}

TEST_F(DataSheets, ExamplesAcceptTheShippedTable) {
  for (const char* name : {"epos4.toml", "elmo.toml", "odrive.toml"})
    for (const JointConfig& joint : read(example(name)).joints)
      EXPECT_GE(joint.loop.controller.torque_limit_Nm, 34.0) << name;
}

}  // namespace
}  // namespace strainwave
