// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/event_log.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/input_error.h"
#include "base/text_file.h"
#include "tests/support/event_log_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class EventLogTest : public ::testing::Test {
 protected:
  std::string refusal() const {
    return testing::refusal_of([&] {
      EventLogReader reader(path_);
      LogEvent event;
      while (reader.next(event)) {
      }
    });
  }
  struct Read {
    int events = 0;
    std::set<std::uint8_t> last_bytes;
    LogDamage damage;
    bool truncated = false;
  };
  Read read_all() const {
    EventLogReader reader(path_);
    Read read;
    for (LogEvent event; reader.next(event); ++read.events)
      if (!event.data.empty()) read.last_bytes.insert(event.data.back());
    read.damage = reader.damage();
    read.truncated = reader.truncated();
    return read;
  }
  std::string bytes() const { return read_text_file(path_); }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
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

TEST_F(EventLogTest, PassesOverOneDamagedPlaceAndSaysHowMuchAndWhere) {
  testing::EventLogFile log(path_);
  const std::size_t event_bytes = 28 + 14 + 4;
  for (int i = 0; i < 5; ++i) log.add_bytes(i, "SW.elbow.STATE", {1, 2, 3, static_cast<std::uint8_t>(i)});
  const std::string whole = bytes();
  ASSERT_EQ(whole.size(), 5 * event_bytes);
  // Damages each byte in turn. Only the event with that byte may be lost.
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    write(damaged);
    const std::size_t hit = at / event_bytes;
    const Read read = read_all();
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_TRUE(i == hit || read.last_bytes.contains(static_cast<std::uint8_t>(i))) << i << " at " << at;
    EXPECT_EQ(read.damage.skipped_bytes % event_bytes, 0U) << at;
    if (read.damage.places > 0) {
      EXPECT_EQ(read.damage.first_byte, hit * event_bytes);
    }
  }
}

TEST_F(EventLogTest, FindsTheEventsBehindWhatIsNoLog) {
  testing::EventLogFile(path_).add_bytes(1, "SW.elbow.STATE", {1, 2, 3, 4});
  const std::string event = bytes();
  std::string junk(5000, 'x');
  junk.replace(100, 4, "\xED\xA1\xDA\x01");  // sync word without an event
  write(event + junk + event + junk + event);
  const Read read = read_all();
  EXPECT_EQ(read.events, 3);
  EXPECT_EQ(read.damage.places, 2);
  EXPECT_EQ(read.damage.skipped_bytes, 2 * junk.size());
  EXPECT_EQ(read.damage.first_byte, event.size());
  EXPECT_FALSE(read.truncated);
}

TEST_F(EventLogTest, ALengthThatCannotBeTakesNoOtherEventAlong) {
  testing::EventLogFile log(path_);
  log.add_bytes(1, "A", {1});
  log.put(testing::kLogSyncWord, 4);
  log.put(1, 8);
  log.put(1, 8);
  log.put(1, 4);
  log.put(15 << 20, 4);  // data beyond the file's end
  log.add_bytes(2, "A", {2});
  const Read read = read_all();
  EXPECT_EQ(read.events, 2);
  EXPECT_EQ(read.damage.first_byte, 30U);
  EXPECT_EQ(read.damage.skipped_bytes, 28U);
}

TEST_F(EventLogTest, OfSyncWordsAloneIsReadOnce) {
  // Each header could begin an event of 15 MB. A new search for its end at each header would take minutes.
  testing::EventLogFile log(path_);
  log.add_bytes(1, "A", {1});
  std::string header = "\xED\xA1\xDA\x01";
  header += std::string(16, '\0') + std::string("\0\0\0\x01\x00\xF0\0\0", 8);
  std::string text = bytes();
  while (text.size() < (4U << 20)) text += header;
  write(text);
  EXPECT_EQ(read_all().damage.places, 1);
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
    refusal();  // no crash, no endless loop, no huge allocation
  }
}

TEST_F(EventLogTest, SaysWhichFileIsNotThere) {
  EXPECT_THROW(EventLogReader("/nonexistent/a.lcm"), InputError);
  EXPECT_THROW(EventLogReader(folder_.path()), InputError);
}

}  // namespace
}  // namespace strainwave
