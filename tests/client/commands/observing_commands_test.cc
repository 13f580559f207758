// SPDX-License-Identifier: BSD-3-Clause
// Commands that only observe: status, watch, record, timing.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <strainwave/timing_v1.hpp>

#include "client/protocol/output_file.h"
#include "lcmtypes/event_log.h"
#include "tests/client/commands/commands_fixture.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

using testing::CommandsTest;

TEST_F(CommandsTest, StatusShowsEveryJointOrEveryFieldOfOne) {
  daemon.publish_state(Mode::kHolding);
  FakeDaemon(connection, "SW", "wrist").publish_state(Mode::kTracking);
  show_status(client, output, {});
  EXPECT_TRUE(output_has("elbow"));
  EXPECT_TRUE(output_has("wrist"));
  stream.str("");
  show_status(client, output, {"elbow"});
  EXPECT_TRUE(output_has("torque_feedforward_Nm"));
  EXPECT_FALSE(output_has("wrist"));
}

TEST_F(CommandsTest, StatusAsJsonWritesNullForWhatIsNotFinite) {
  daemon.state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
  daemon.publish_state(Mode::kHolding);
  output.json = true;
  show_status(client, output, {"elbow"});
  EXPECT_TRUE(output_has("\"temperature_used_C\": null")) << stream.str();
  EXPECT_TRUE(output_has("\"mode_text\": \"holding\"")) << stream.str();
}

TEST_F(CommandsTest, StatusAsJsonWritesNamesOf64BitsAsTexts) {
  constexpr std::int64_t kName = 0x7fff'ffff'ffff'fff1;  // a double would round it
  daemon.state.session_id = daemon.state.challenge = daemon.state.owner_id = daemon.state.table_id = kName;
  daemon.publish_state(Mode::kHolding);
  output.json = true;
  show_status(client, output, {"elbow"});
  for (const char* const field : {"session_id", "challenge", "owner_id", "table_id"})
    EXPECT_TRUE(output_has("\"" + std::string(field) + "\": \"9223372036854775793\""))
        << field << " in " << stream.str();
}

TEST_F(CommandsTest, WatchWithoutATerminalWritesLinesWithoutControlCharacters) {
  daemon.publish_state(Mode::kHolding);
  watch(client, output, {{"elbow"}, 0.02, 0.1, false});
  EXPECT_EQ(stream.str().find('\x1b'), std::string::npos);
  EXPECT_TRUE(output_has("elbow"));
}

TEST_F(CommandsTest, StatusNamesTheDaemonOnlyWhenSeveralAreHeard) {
  Client all{connection, {"SW", 0.3, "", true}};
  FakeDaemon other(connection, "ARM2", "elbow");
  daemon.publish_state(Mode::kHolding);
  show_status(all, output, {});
  EXPECT_FALSE(output_has("SW.elbow"));
  stream.str("");
  other.publish_state(Mode::kOff);
  show_status(all, output, {});
  EXPECT_TRUE(output_has("SW.elbow")) << stream.str();
  EXPECT_TRUE(output_has("ARM2.elbow")) << stream.str();
  stream.str("");
  show_status(client, output, {});
  EXPECT_FALSE(output_has("ARM2")) << "the prefix was chosen";
}

TEST_F(CommandsTest, RecordWritesEveryMessageOfTheChosenJoints) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "record.lcm";
  FakeDaemon wrist(connection, "SW", "wrist");
  daemon.publish_state(Mode::kHolding);
  client.wait_for_joint("elbow");
  for (int i = 0; i < 20; ++i) {
    daemon.publish_state();
    wrist.publish_state();
  }
  connection.publish("OTHER.elbow.STATE", encode(state_v1{}));
  record(client, output, {{"elbow"}, file, 0.2, false});
  std::map<std::string, int> counts;
  EventLogReader reader(file);
  for (LogEvent event; reader.next(event);) ++counts[event.channel];
  EXPECT_EQ(counts, (std::map<std::string, int>{{"SW.elbow.STATE", 20}}));
}

TEST_F(CommandsTest, RecordNeverReplacesAFileUnasked) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "record_kept.lcm";
  std::ofstream(file) << "precious\n";
  daemon.publish_state();
  const auto attempt = [&](bool overwrite) {
    return status_of([&] { record(client, output, {{"elbow"}, file, 0.01, overwrite}); });
  };
  EXPECT_EQ(attempt(false), ExitStatus::kUsage);
  std::string first;
  std::getline(std::ifstream(file), first);
  EXPECT_EQ(first, "precious");
  EXPECT_EQ(attempt(true), ExitStatus::kDone);
}

TEST_F(CommandsTest, RecordRefusesAFolderAndTheNameOfAnotherFormat) {
  const TemporaryFolder folder;
  daemon.publish_state();
  const auto attempt = [&](const std::filesystem::path& file, bool mcap) {
    return status_of([&] { record(client, output, {{"elbow"}, file, 0.01, true, mcap}); });
  };
  for (const bool mcap : {false, true}) {
    EXPECT_EQ(attempt(folder.path(), mcap), ExitStatus::kUsage);
    EXPECT_TRUE(message_has("is a folder: name a file")) << message;
    for (const char* name : {"a.lcm", "a.csv", "a.mcap"}) {
      const bool right = mcap ? name == std::string("a.mcap") : name == std::string("a.lcm");
      EXPECT_EQ(attempt(folder.path() / name, mcap), right ? ExitStatus::kDone : ExitStatus::kUsage) << name;
      EXPECT_EQ(std::filesystem::exists(folder.path() / name), right) << name;
    }
    std::filesystem::remove(folder.path() / (mcap ? "a.mcap" : "a.lcm"));
  }
}

TEST_F(CommandsTest, RecordLeavesAFileAloneThatAnotherRecorderWrites) {
  const TemporaryFolder folder;
  daemon.publish_state();
  for (const bool mcap : {false, true}) {
    const auto file = folder.path() / (mcap ? "record.mcap" : "record.lcm");
    const UniqueFd other = claim_output(file, false);
    std::ofstream(file) << "theirs\n";
    EXPECT_EQ(status_of([&] {
                record(client, output, {{"elbow"}, file, 0.01, true, mcap});
              }),
              ExitStatus::kUsage);
    std::string first;
    std::getline(std::ifstream(file), first);
    EXPECT_EQ(first, "theirs");
  }
  EXPECT_EQ(status_of([&] {
              record(client, output, {{"elbow"}, folder.path() / "record.lcm", 0.01, true, false});
            }),
            ExitStatus::kDone)
      << "the other one has ended";
}

TEST_F(CommandsTest, RecordSaysSoWhenTheFileCannotBeWritten) {
  daemon.publish_state();
  EXPECT_EQ(status_of([&] {
              record(client, output, {{"elbow"}, "/nonexistent/a.lcm", 0.01, false});
            }),
            ExitStatus::kUsage);
}

TEST_F(CommandsTest, NoFileIsNamedForAFormatThatItIsNot) {
  const TemporaryFolder folder;
  daemon.publish_state();
  for (const char* name : {"a.mcap", "a.csv"}) {
    EXPECT_EQ(status_of([&] {
                record(client, output, {{"elbow"}, folder.path() / name, 0.01});
              }),
              ExitStatus::kUsage);
    EXPECT_TRUE(message_has(name)) << message;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name));
  }
  const auto log = folder.path() / "a.lcm";
  record(client, output, {{"elbow"}, log, 0.01});
  EXPECT_EQ(status_of([&] { export_log(output, {log, folder.path() / "b.mcap"}); }), ExitStatus::kUsage);
  EXPECT_TRUE(message_has("--mcap")) << message;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.mcap"));
}

TEST_F(CommandsTest, ExportDoesNotDestroyWhatItReads) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "a.lcm";
  daemon.publish_state();
  client.wait_for_joint("elbow");
  daemon.publish_state();
  record(client, output, {{"elbow"}, log, 0.05});
  const auto size = std::filesystem::file_size(log);
  ASSERT_GT(size, 0U);
  std::filesystem::create_symlink(log, folder.path() / "same.lcm");
  for (const char* name : {"a.lcm", "same.lcm"}) {
    EXPECT_EQ(status_of([&] {
                export_log(output, {log, folder.path() / name, true, true});
              }),
              ExitStatus::kUsage);
    EXPECT_TRUE(message_has("is the log that export reads")) << message;
    EXPECT_EQ(std::filesystem::file_size(log), size);
  }
}

TEST_F(CommandsTest, ExportSaysThatThereWasNothing) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "empty.lcm";
  std::ofstream{log};
  for (const char* name : {"states.csv", "folder"}) {
    stream.str("");
    export_log(output, {log, folder.path() / name});
    EXPECT_TRUE(output_has("nothing in")) << name << ": " << stream.str();
  }
}

/// memq:// drops messages without a subscriber. This class sends the message once a first message, the trigger, is dispatched.
class LaterTiming {
 public:
  LaterTiming(Connection& connection, const timing_v1& timing)
      : connection_(connection),
        timing_(timing),
        subscription_(connection.subscribe("TRIGGER", &LaterTiming::on_trigger, this)) {
    connection_.publish("TRIGGER", encode(timing));
  }

 private:
  void on_trigger(const ReceivedMessage&) { connection_.publish("SW.TIMING", encode(timing_)); }

  Connection& connection_;
  timing_v1 timing_;
  Subscription subscription_;
};

TEST_F(CommandsTest, TimingSaysWhetherRealTimeIsUsedAndWhatWasRefused) {
  timing_v1 timing{};
  timing.real_time = 0;
  timing.rejects[static_cast<int>(Reason::kWrongSession)] = 3;
  const LaterTiming later(connection, timing);
  show_timing(client, output);
  EXPECT_TRUE(output_has("no (refused by the system)"));
  EXPECT_TRUE(output_has("3 (another session of the daemon)")) << stream.str();
}

TEST_F(CommandsTest, TimingTellsScriptsWhatWasRefusedForEachReason) {
  timing_v1 timing{};
  timing.rejects[static_cast<int>(Reason::kWrongSession)] = 3;
  timing.rejects[static_cast<int>(Reason::kOldSequence)] = 2;
  const LaterTiming later(connection, timing);
  show_timing(client, {stream, false, true});
  EXPECT_TRUE(output_has(R"("another session of the daemon":3)")) << stream.str();
  EXPECT_TRUE(output_has(R"(":2)")) << stream.str();
}

TEST_F(CommandsTest, TimingSaysSoWhenNoneComes) {
  EXPECT_EQ(status_of([&] { show_timing(client, output); }), ExitStatus::kNoAnswer);
}

}  // namespace
}  // namespace strainwave
