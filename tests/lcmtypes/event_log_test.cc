#include "lcmtypes/event_log.h"

#include <gtest/gtest.h>

#include <random>

#include "base/input_error.h"
#include "tests/support/event_log_file.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class EventLogTest : public ::testing::Test {
 protected:
  std::string refusal() const {
    try {
      EventLogReader reader(path_);
      LogEvent event;
      while (reader.next(event)) {
      }
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.lcm";
};

TEST_F(EventLogTest, ReadsEveryEventInItsOrder) {
  testing::EventLogFile log(path_);
  log.add_bytes(1700000000000001, "SW.elbow.STATE", {1, 2, 3});
  log.add_bytes(1700000000000002, "SW.TIMING", {});
  EventLogReader reader(path_);
  LogEvent event;
  ASSERT_TRUE(reader.next(event));
  EXPECT_EQ(event.number, 0);
  EXPECT_EQ(event.received_us, 1700000000000001);
  EXPECT_EQ(event.channel, "SW.elbow.STATE");
  EXPECT_EQ(event.data, (std::vector<std::uint8_t>{1, 2, 3}));
  ASSERT_TRUE(reader.next(event));
  EXPECT_EQ(event.number, 1);
  EXPECT_TRUE(event.data.empty());
  EXPECT_FALSE(reader.next(event));
  EXPECT_FALSE(reader.truncated());
}

TEST_F(EventLogTest, ALogThatWasCutOffEndsWithItsLastWholeEvent) {
  testing::EventLogFile(path_).add_bytes(1, "SW.elbow.STATE", {1, 2, 3, 4});
  const auto whole = std::filesystem::file_size(path_);
  for (std::uintmax_t size = 1; size < whole; ++size) {
    std::filesystem::resize_file(path_, whole);
    testing::EventLogFile(path_).add_bytes(1, "SW.elbow.STATE", {1, 2, 3, 4});
    std::filesystem::resize_file(path_, size);
    EventLogReader reader(path_);
    LogEvent event;
    EXPECT_FALSE(reader.next(event)) << size;
    EXPECT_TRUE(reader.truncated()) << size;
  }
}

TEST_F(EventLogTest, RefusesLengthsThatCannotBeAndNamesThePlace) {
  testing::EventLogFile log(path_);
  log.add_bytes(1, "A", {1});
  log.put(testing::kLogSyncWord, 4);
  log.put(1, 8);
  log.put(1, 8);
  log.put(0xFFFFFFFF, 4);  // the channel's length
  log.put(1, 4);
  EXPECT_NE(refusal().find("at byte 30"), std::string::npos) << refusal();
}

TEST_F(EventLogTest, NamesAnMcapFileForWhatItIs) {
  std::ofstream(path_, std::ios::binary) << "\x89MCAP0\r\n" << std::string(100, 'x');
  EXPECT_NE(refusal().find("MCAP file"), std::string::npos) << refusal();
}

TEST_F(EventLogTest, SurvivesAnyBytes) {
  std::mt19937 random(5);
  for (int run = 0; run < 300; ++run) {
    std::ofstream file(path_, std::ios::binary);
    if (run % 2 == 0) file.write("\xED\xA1\xDA\x01", 4);
    for (int i = 0; i < 200; ++i) file.put(static_cast<char>(random()));
    file.close();
    refusal();  // whatever it is: no crash, no endless loop, no huge allocation
  }
}

TEST_F(EventLogTest, SaysWhichFileIsNotThere) {
  EXPECT_THROW(EventLogReader("/nonexistent/a.lcm"), InputError);
  EXPECT_THROW(EventLogReader(folder_.path()), InputError);
}

}  // namespace
}  // namespace strainwave
