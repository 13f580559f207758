// SPDX-License-Identifier: BSD-3-Clause
// The client over a real LCM network, with a fake daemon in its own thread and the command line as a user types it.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/options/command_line.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/multicast_check.h"
#include "lcmtypes/wire.h"
#include "tests/client/protocol/running_daemon.h"
#include "tests/support/fragment_attack.h"
#include "tests/support/multicast_sender.h"

namespace strainwave {
namespace {

struct Result {
  ExitStatus status;
  std::string out;
  std::string err;
};

Result run(const std::string& url, std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"strainwavectl", "--lcm-url", url.c_str(), "--timeout_s", "5"});
  std::ostringstream out;
  std::ostringstream err;
  const ExitStatus status =
      run_command_line(static_cast<int>(arguments.size()), arguments.data(), out, err, false);
  return {status, out.str(), err.str()};
}

TEST(ClientOverMulticast, GetsOrdersDoneAndShowsTheirEffect) {
  const std::string url = own_url();
  const RunningDaemon daemon(url);
  EXPECT_EQ(run(url, {"enable", "elbow"}).status, ExitStatus::kDone);
  const Result moved = run(url, {"move", "elbow", "-0.125", "--wait"});
  EXPECT_EQ(moved.status, ExitStatus::kDone) << moved.err;
  const Result status = run(url, {"status", "elbow", "--json"});
  EXPECT_NE(status.out.find("\"target_position_rad\": -0.125"), std::string::npos) << status.out;
}

TEST(ClientOverMulticast, NamesTheCommandThatClearsAFault) {
  const std::string url = own_url();
  RunningDaemon daemon(url);
  daemon.daemon().after_answer = [&] {
    daemon.daemon().state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  };
  const Result moved = run(url, {"move", "elbow", "0.5", "--wait"});
  EXPECT_EQ(moved.status, ExitStatus::kRefused);
  EXPECT_NE(moved.err.find("; once the cause is gone: strainwavectl clear-fault elbow\n"), std::string::npos)
      << moved.err;
}

TEST(ClientOverMulticast, RecordsWhatItReceives) {
  const std::string url = own_url();
  const RunningDaemon daemon(url);
  const auto file =
      std::filesystem::path(::testing::TempDir()) / ("network_record_" + std::to_string(::getpid()) + ".lcm");
  const Result result = run(url, {"record", "elbow", "--out", file.c_str(), "--duration_s", "0.3"});
  EXPECT_EQ(result.status, ExitStatus::kDone) << result.err;
  EventLogReader reader(file);
  int states = 0;
  for (LogEvent event; reader.next(event);) states += event.channel == "SW.elbow.STATE" ? 1 : 0;
  EXPECT_GT(states, 0);
  EXPECT_NE(result.out.find("; none is missing\n"), std::string::npos) << result.out;
  std::filesystem::remove(file);
}

TEST(ClientOverMulticast, RecordTellsHowManyMessagesAreMissing) {
  const std::string url = own_url();
  const auto file =
      std::filesystem::path(::testing::TempDir()) / ("missing_record_" + std::to_string(::getpid()) + ".lcm");
  std::jthread sending([&](const std::stop_token& stop) {
    const testing::MulticastSender sender(static_cast<std::uint16_t>(parse_udpm_url(url)->port));
    for (std::uint32_t sequence = 0; !stop.stop_requested(); sequence += 3) {
      sender.send(testing::short_datagram("SW.elbow.STATE", encode(state_v1{}), sequence));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const Result result =
      run(url, {"--json", "record", "elbow", "--out", file.c_str(), "--duration_s", "0.3", "--overwrite"});
  EXPECT_EQ(result.status, ExitStatus::kDone) << result.err;
  const std::string last = result.out.substr(result.out.rfind('\n', result.out.size() - 2) + 1);
  const auto summary = nlohmann::json::parse(last);
  EXPECT_GT(summary.at("messages").get<int>(), 10) << result.out;
  // Two states are missing between any two messages. A few more at both ends are counted as missing.
  EXPECT_NEAR(summary.at("missing").get<double>(), 2.0 * summary.at("messages").get<double>(), 20.0)
      << result.out;
  std::filesystem::remove(file);
}

TEST(ClientOverMulticast, SurvivesMessagesThatAreNone) {
  const std::string url = own_url();
  const RunningDaemon daemon(url);
  Connection attacker(url);
  std::atomic<bool> stop{false};
  std::thread noise([&] {
    const std::vector<std::uint8_t> junk(37, 0xFF);
    std::vector<std::uint8_t> long_state = encode(state_v1{});
    long_state.push_back(0);
    while (!stop) {
      for (const char* channel : {"SW.elbow.STATE", "SW.elbow.ACK", "SW..STATE", "SW.TIMING"}) {
        attacker.publish(channel, junk);
        attacker.publish(channel, long_state);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const Result result = run(url, {"enable", "elbow"});
  stop = true;
  noise.join();
  EXPECT_EQ(result.status, ExitStatus::kDone) << result.err;
}

// These fragments crash any program that receives with LCM's library. The client has its own receiver.
TEST(ClientOverMulticast, SurvivesTheFragmentsThatCrashLcmsLibraryAndStillSeesOrdersAndRecords) {
  const std::string url = own_url();
  const RunningDaemon daemon(url);
  const auto file =
      std::filesystem::path(::testing::TempDir()) / ("attack_record_" + std::to_string(::getpid()) + ".lcm");
  const testing::FragmentAttack attack(
      url, {"SW.elbow.STATE", "SW.elbow.ACK", "SW.elbow.COMMAND", "SW.elbow.LIMITS", "SW.TIMING"});
  const Result status = run(url, {"status", "elbow"});
  EXPECT_EQ(status.status, ExitStatus::kDone) << status.err;
  EXPECT_NE(status.out.find("joint_position_rad"), std::string::npos) << status.out;
  const Result watched = run(url, {"watch", "--plain", "--interval_s", "0.1", "--duration_s", "0.5"});
  EXPECT_EQ(watched.status, ExitStatus::kDone) << watched.err;
  EXPECT_NE(watched.out.find("holding"), std::string::npos) << watched.out;
  const Result recorded = run(url, {"record", "elbow", "--out", file.c_str(), "--duration_s", "0.3"});
  EXPECT_EQ(recorded.status, ExitStatus::kDone) << recorded.err;
  EXPECT_NE(recorded.out.find("SW.elbow.STATE"), std::string::npos) << recorded.out;
  EXPECT_EQ(run(url, {"enable", "elbow"}).status, ExitStatus::kDone);
  EXPECT_GT(attack.rounds(), 100U);
  std::filesystem::remove(file);
}

TEST(ClientOverMulticast, HearsNoDaemonOnAnotherPort) {
  const std::string url = own_url();
  std::ostringstream out;
  std::ostringstream err;
  const std::vector<const char*> arguments{"strainwavectl", "--lcm-url", url.c_str(),
                                           "--timeout_s",   "0.2",       "status"};
  EXPECT_EQ(run_command_line(static_cast<int>(arguments.size()), arguments.data(), out, err, false),
            ExitStatus::kNoAnswer);
  EXPECT_NE(err.str().find("no daemon on prefix SW"), std::string::npos) << err.str();
}

TEST(ClientOverMulticast, TellsARefusalAsJson) {
  const std::string url = own_url();
  RunningDaemon daemon(url);
  daemon.daemon().reason = Reason::kOutOfRange;
  daemon.daemon().text = "position_rad = 9: from -3 to 3 is allowed";
  const Result result = run(url, {"move", "elbow", "9", "--json"});
  EXPECT_EQ(result.status, ExitStatus::kRefused);
  EXPECT_EQ(result.out, "");
  const auto json = nlohmann::json::parse(result.err);
  EXPECT_EQ(json.at("error"), "refused");
  EXPECT_EQ(json.at("joint"), "elbow");
  EXPECT_EQ(json.at("reason"), static_cast<int>(Reason::kOutOfRange));
  EXPECT_EQ(json.at("allowed"), "from -3 to 3");
}

// A child process enters a network namespace without any route. The client must explain how to add one.
TEST(ClientWithoutMulticast, SaysHowToAddTheRoute) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  constexpr int kNotPermitted = 99;
  if (child == 0) {
    if (::unshare(CLONE_NEWNET) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) ::_exit(kNotPermitted);
    const std::string problem = find_multicast_problem("udpm://239.255.76.67:7667?ttl=0").value_or("");
    const bool helpful = problem.find("ip route add 239.255.76.67/32 dev lo") != std::string::npos;
    const bool status_5 = run("udpm://239.255.76.67:7667?ttl=0", {"status"}).status == ExitStatus::kNoAnswer;
    ::_exit(helpful && status_5 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNotPermitted) GTEST_SKIP() << "this system does not permit network namespaces";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace strainwave
