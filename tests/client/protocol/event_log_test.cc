// SPDX-License-Identifier: BSD-3-Clause
// The event logs that the client writes and reads.
#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <fstream>
#include <sstream>

#include "base/input_error.h"
#include "base/text_file.h"
#include "client/commands/commands.h"
#include "client/protocol/event_log_writer.h"
#include "client/text/message_csv.h"
#include "client/text/state_csv.h"
#include "strainwave/client_error.h"
#include "tests/client/protocol/fake_daemon.h"
#include "tests/support/event_log_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

class EventLogs : public ::testing::Test {
 protected:
  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
  std::ostringstream out_;
  Output output_{out_, false};
};

TEST_F(EventLogs, AreNoFolders) {
  const std::string refused = testing::refusal_of([&] { export_log(output_, {folder_, folder_ / "a.csv"}); });
  EXPECT_NE(refused.find("is a folder, not a file"), std::string::npos) << refused;
}

TEST_F(EventLogs, WhatTheClientWritesLcmsOwnReaderReads) {
  Connection connection("memq://");
  const auto path = folder_ / "a.lcm";
  {
    EventLogWriter writer(connection, "SW", {}, path, false);
    connection.publish("SW.elbow.STATE", std::vector<std::uint8_t>{1, 2, 3});
    connection.publish("SW.TIMING", std::vector<std::uint8_t>{4});
    while (connection.handle(0)) {
    }
    writer.finish();
  }
  lcm_eventlog_t* log = ::lcm_eventlog_create(path.c_str(), "r");
  ASSERT_NE(log, nullptr);
  lcm_eventlog_event_t* first = ::lcm_eventlog_read_next_event(log);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->eventnum, 0);
  EXPECT_GT(first->timestamp, 1'600'000'000'000'000);
  EXPECT_STREQ(first->channel, "SW.elbow.STATE");
  ASSERT_EQ(first->datalen, 3);
  EXPECT_EQ(static_cast<const std::uint8_t*>(first->data)[2], 3);
  ::lcm_eventlog_free_event(first);
  lcm_eventlog_event_t* second = ::lcm_eventlog_read_next_event(log);
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(second->eventnum, 1);
  ::lcm_eventlog_free_event(second);
  EXPECT_EQ(::lcm_eventlog_read_next_event(log), nullptr);
  ::lcm_eventlog_destroy(log);
}

TEST_F(EventLogs, ExportWritesOneFilePerChannel) {
  testing::EventLogFile log(folder_ / "a.lcm");
  state_v1 state{};
  state.joint_position_rad = 0.25;
  state.rule_count = 3;
  log.add(100, "SW.elbow.STATE", state);
  log.add(200, "SW.elbow.STATE", state);
  log.add(300, "SW.wrist.TEMPERATURE", temperature_v1{});
  log.add_bytes(400, "SW.wrist.STATE", {1, 2});
  log.add_bytes(400, "CAMERA", {1, 2});
  log.add_bytes(400, "SW.../../x.STATE", {1, 2});
  export_log(output_, {folder_ / "a.lcm", folder_ / "csv", false});
  const auto states = lines_of(folder_ / "csv" / "SW.elbow.STATE.csv");
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[0], "received_us,time_s" + state_csv_columns(3)) << "the most weights that a state uses";
  EXPECT_TRUE(states[2].starts_with("200,0.000100,")) << states[2];
  EXPECT_NE(states[2].find(",0.25,"), std::string::npos);
  EXPECT_EQ(lines_of(folder_ / "csv" / "SW.wrist.TEMPERATURE.csv").size(), 2U);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "csv" / "SW.wrist.STATE.csv"));
  EXPECT_NE(out_.str().find("3 other messages"), std::string::npos) << out_.str();
}

TEST_F(EventLogs, ExportToOneCsvWritesTheStatesOfAllJoints) {
  testing::EventLogFile log(folder_ / "a.lcm");
  log.add(100, "SW.elbow.STATE", state_v1{});
  log.add(100, "SW.wrist.STATE", state_v1{});
  log.add(100, "SW.wrist.TEMPERATURE", temperature_v1{});
  export_log(output_, {folder_ / "a.lcm", folder_ / "a.csv", false});
  const auto lines = lines_of(folder_ / "a.csv");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "joint,time_s" + state_csv_columns(0));
  EXPECT_TRUE(lines[1].starts_with("elbow,0.000000,0,"));
  EXPECT_TRUE(lines[2].starts_with("wrist,0.000000,0,"));
  EXPECT_THROW(export_log(output_, {folder_ / "a.lcm", folder_ / "a.csv", false}), ClientError);
}

TEST_F(EventLogs, ExportSaysSoWhenTheLogIsCutOff) {
  testing::EventLogFile(folder_ / "a.lcm").add(100, "SW.elbow.STATE", state_v1{});
  std::filesystem::resize_file(folder_ / "a.lcm", std::filesystem::file_size(folder_ / "a.lcm") - 1);
  export_log(output_, {folder_ / "a.lcm", folder_ / "a.csv", false});
  EXPECT_NE(out_.str().find("cut off"), std::string::npos);
}

TEST_F(EventLogs, ExportGoesOnBehindADamagedPlaceAndSaysWhatItSkipped) {
  const auto path = folder_ / "a.lcm";
  testing::EventLogFile(path).add(200, "SW.elbow.STATE", state_v1{});
  const std::string event = read_text_file(path);
  std::ofstream(path, std::ios::binary) << event << std::string(5000, 'x') << event;
  export_log(output_, {path, folder_ / "a.csv", false});
  EXPECT_EQ(lines_of(folder_ / "a.csv").size(), 3U);
  EXPECT_NE(out_.str().find("5000 bytes in 1 place skipped, from byte " + std::to_string(event.size())),
            std::string::npos)
      << out_.str();
  EXPECT_EQ(out_.str().find("fall"), std::string::npos) << out_.str();
}

TEST_F(EventLogs, ExportNotesTimesThatFall) {
  testing::EventLogFile log(folder_ / "a.lcm");
  for (const int received_us : {300, 400, 100, 200}) log.add(received_us, "SW.elbow.STATE", state_v1{});
  export_log(output_, {folder_ / "a.lcm", folder_ / "a.csv", false});
  EXPECT_NE(out_.str().find("times of receipt jump back once"), std::string::npos) << out_.str();
}

TEST_F(EventLogs, ExportOfSomethingElseCreatesNothing) {
  std::ofstream(folder_ / "a.txt") << "no log\n";
  EXPECT_THROW(export_log(output_, {folder_ / "none.lcm", folder_ / "a.csv", false}), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.csv"));
  EXPECT_THROW(export_log(output_, {folder_ / "a.txt", folder_ / "b.csv", false}), InputError);
}

TEST_F(EventLogs, PlayWantsAKeyBeforeItLooksAtAnything) {
  Connection connection("memq://");
  Client client(connection, {"SW", 0.1, ""});
  try {
    play(client, output_, {folder_ / "none.lcm", "elbow"});
    FAIL();
  } catch (const ClientError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kUsage);
    EXPECT_NE(std::string(error.what()).find("--key"), std::string::npos);
  }
}

}  // namespace
}  // namespace strainwave
