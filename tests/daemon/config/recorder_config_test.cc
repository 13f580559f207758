// SPDX-License-Identifier: BSD-3-Clause
// The keys of groups, the flight recorder, injected faults and the temperature's period.
#include <stdlib.h>
#include <unistd.h>

#include <string>

#include "daemon/config/config.h"
#include "tests/daemon/config/config_file_test.h"

namespace strainwave {
namespace {

class RecorderConfigTest : public ConfigFileTest {
 protected:
  void SetUp() override { ::unsetenv("STATE_DIRECTORY"); }
  void TearDown() override { ::unsetenv("STATE_DIRECTORY"); }
  static std::string joint(const std::string& name, const std::string& keys = "",
                           const std::string& tables = "") {
    return "[[joint]]\nname = \"" + name +
           "\"\njoint_model = \"rhs17-6006\"\nmodel = \"rigid\"\ninertia_kgm2 = 0.089\ngear_ratio = "
           "50\ndriver = \"simulated\"\n"
           "limits = { position_min_rad = -3, position_max_rad = 3, speed_limit_rad_s = 6, "
           "acceleration_rad_s2 = "
           "150, "
           "following_error_rad = 0.1, torque_limit_Nm = 34 }\n" +
           keys + tables;
  }
  static std::string simulated(const std::string& text) {
    return "[security]\nunsigned_orders = \"allow\"\n" + text;
  }
  DaemonConfig read(const std::string& text) { return ConfigFileTest::read(simulated(text)); }
  std::string error(const std::string& text) { return error_of(simulated(text)); }
};

TEST_F(RecorderConfigTest, NumbersGroupsByTheirNames) {
  const DaemonConfig config = read(joint("a", "group = \"arm\"\n") + joint("b") +
                                   joint("c", "group = \"hand\"\n") + joint("d", "group = \"arm\"\n"));
  EXPECT_EQ(config.joints[0].loop.group, config.joints[3].loop.group);
  EXPECT_NE(config.joints[0].loop.group, config.joints[2].loop.group);
  EXPECT_EQ(config.joints[1].loop.group, -1);
}

TEST_F(RecorderConfigTest, RecordsNothingWithoutADirectory) {
  EXPECT_FALSE(read(joint("a")).recorder.enabled());
  ::setenv("STATE_DIRECTORY", "/var/lib/strainwave", 1);
  EXPECT_EQ(read(joint("a")).recorder.directory, "/var/lib/strainwave/flight-records");
}

TEST_F(RecorderConfigTest, KeepsLearnedFrictionInTheStateDirectoryOfTheFileOrElseOfTheService) {
  EXPECT_TRUE(read(joint("a")).state_directory.empty());
  ::setenv("STATE_DIRECTORY", "/var/lib/strainwave:/var/lib/other", 1);
  EXPECT_EQ(read(joint("a")).state_directory, "/var/lib/strainwave");
  EXPECT_EQ(read("[daemon]\nstate_directory = \"kept\"\n" + joint("a")).state_directory, folder_ / "kept");
}

TEST_F(RecorderConfigTest, ReadsTheRecorderWithPathsBesideTheConfiguration) {
  const RecorderConfig recorder =
      read(joint("a") + "[recorder]\ndirectory = \"records\"\nseconds = 2\nmax_files = 7\n").recorder;
  EXPECT_EQ(recorder.directory, folder_ / "records");
  EXPECT_EQ(recorder.seconds, 2.0);
  EXPECT_EQ(recorder.post_trigger_s, 0.2) << "a tenth, unless said otherwise";
  EXPECT_EQ(recorder.max_files, 7);
}

TEST_F(RecorderConfigTest, DoubtsADirectoryInWhichNothingCanBeWritten) {
  const auto doubts = [&](const std::string& directory) {
    std::string text;
    for (const std::string& warning :
         read(joint("a") + "[recorder]\ndirectory = \"" + directory + "\"\n").warnings)
      text += warning;
    return text;
  };
  EXPECT_EQ(doubts("not/made/yet"), "");
  std::ofstream(folder_ / "file") << "no folder";
  expect_mentions(doubts("file/records"), {"recorder.directory = \"file/records\"", "/file is not a folder"});
  // Root may write everywhere, unless the file system refuses it.
  const std::filesystem::path closed = folder_ / "closed";
  std::filesystem::create_directory(closed);
  std::filesystem::permissions(closed,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (::access(closed.c_str(), W_OK) == 0) return;
  expect_mentions(doubts("closed/records"),
                  {"recorder.directory = \"closed/records\"", "/closed: Permission denied"});
}

TEST_F(RecorderConfigTest, DoubtsADirectoryInWhichOthersCanWrite) {
  using std::filesystem::perms;
  const std::filesystem::path open = folder_ / "open";
  std::filesystem::create_directory(open);
  const auto doubts = [&](const std::string& directory, perms permissions) {
    std::filesystem::permissions(open, permissions);
    std::string text;
    for (const std::string& warning :
         read(joint("a") + "[recorder]\ndirectory = \"" + directory + "\"\n").warnings)
      text += warning;
    return text;
  };
  expect_mentions(doubts("open", perms::all), {"recorder.directory = \"open\"", "can write there"});
  expect_mentions(doubts("open/made/later", perms::all), {"other users can write there", "/open"});
  expect_mentions(doubts("open", perms::all | perms::sticky_bit), {"every user can write there"});
  EXPECT_EQ(doubts("open/made/later", perms::all | perms::sticky_bit), "") << "as a folder under /tmp";
  EXPECT_EQ(doubts("open", perms::owner_all | perms::group_all), "");
}

TEST_F(RecorderConfigTest, RefusesRecordsThatDoNotFitIntoMemory) {
  std::string text;
  for (int i = 0; i < 64; ++i) text += joint("j" + std::to_string(i));
  const std::string refusal = error(text + "[recorder]\ndirectory = \"r\"\nseconds = 600\n");
  EXPECT_NE(refusal.find("MB of memory"), std::string::npos) << refusal;
  EXPECT_NO_THROW(read(text + "[recorder]\ndirectory = \"r\"\n"));
}

TEST_F(RecorderConfigTest, ReadsInjectedFaultsAndRefusesUnknownOnes) {
  const std::string sound =
      "[[joint.simulated.fault]]\nkind = \"sensor_jump\"\nat_s = 2\nfor_s = 1\namount = 0.1\n";
  EXPECT_NO_THROW(read(joint("a", "", sound)));
  EXPECT_NE(error(joint("a", "", "[[joint.simulated.fault]]\nkind = \"gremlin\"\n")).find("sensor_stuck"),
            std::string::npos);
  EXPECT_NE(
      error(joint("a", "", "[[joint.simulated.fault]]\nkind = \"sensor_jump\"\n")).find("amount is missing"),
      std::string::npos);
  EXPECT_NE(error(joint("a", "", "[[joint.simulated.fault]]\nkind = \"power_lost\"\namount = 1\n"))
                .find("unknown key"),
            std::string::npos);
}

TEST_F(RecorderConfigTest, TakesOneToSixtyFourJoints) {
  std::string text;
  for (int i = 0; i < 64; ++i) text += joint("j" + std::to_string(i));
  EXPECT_EQ(read(text).joints.size(), 64U);
  EXPECT_NE(error(text + joint("one-too-many")).find("1 to 64"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
