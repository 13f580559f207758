// SPDX-License-Identifier: BSD-3-Clause
// Logs of the running daemon are recorded, exported and played back, or replayed without new signatures. The
// client and LCM's own tools run as programs.
#include <signal.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/text_file.h"
#include "lcmtypes/event_log.h"
#include "tests/support/daemon_fixture.h"
#include "tests/support/event_log_file.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;

constexpr const char* kControl = STRAINWAVE_BINARY_DIR "/bin/strainwavectl --timeout_s 5 ";

class Logs : public DaemonTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(shell(std::string(kControl) + "keygen --out " + path("key") + " --role engineer"), 0)
        << output_;
    ASSERT_EQ(shell("cp " + path("key.pub") + " " + path("authorized_keys")), 0);
    start();
  }
  /// Starts a daemon that obeys signed orders only.
  void start() {
    daemon_.reset();
    std::string text = configuration();
    const std::string open = "unsigned_orders = \"allow\"";
    const auto at = text.find(open);
    ASSERT_NE(at, std::string::npos) << text;
    text.replace(at, open.size(), "authorized_keys = \"authorized_keys\"\nunsigned_orders = \"refuse\"");
    daemon_.emplace(folder_, text);
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_EQ(ctl("load-table elbow " STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json"), 0) << output_;
    ASSERT_EQ(ctl("enable elbow"), 0) << output_;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  int shell(const std::string& command) {
    const std::string log = path("output");
    const int status =
        std::system((command + " > '" + log + "' 2>&1").c_str());  // NOLINT(concurrency-mt-unsafe)
    output_ = read_text_file(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int ctl(const std::string& arguments) {
    return shell(kControl + ("--key " + path("key") + " ") + arguments);
  }
  /// Records while `commands` of strainwavectl run, each with its key.
  void record(const std::string& file, const std::vector<std::string>& commands) {
    std::string script = std::string(kControl) + "record --out " + path(file) + " & recorder=$!; sleep 0.5; ";
    for (const std::string& command : commands)
      script += kControl + ("--key " + path("key") + " ") + command + "; ";
    ASSERT_EQ(shell("bash -c '" + script + "sleep 0.3; kill -INT $recorder; wait $recorder'"), 0) << output_;
  }
  double position_rad() {
    client_->forget_states();
    client_->pump(milliseconds(200));
    return client_->state("elbow")->joint_position_rad;
  }

  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
  std::string output_;
};

TEST_F(Logs, WhatIsRecordedIsExportedAsItWas) {
  record("a.lcm", {"move elbow 0.1 --wait", "move elbow 0.2 --wait"});
  ASSERT_EQ(shell(std::string(kControl) + "export " + path("a.lcm") + " --out " + path("csv")), 0) << output_;
  std::ifstream setpoints(path("csv/SW.elbow.SETPOINT.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(setpoints, line);) lines.push_back(line);
  ASSERT_GE(lines.size(), 3U);
  EXPECT_NE(lines[1].find(",0.1,"), std::string::npos) << lines[1];
  EXPECT_NE(lines.back().find(",0.2,"), std::string::npos) << lines.back();
  for (const char* kind : {"STATE", "TEMPERATURE", "ACK"})
    EXPECT_TRUE(std::filesystem::exists(path(std::string("csv/SW.elbow.") + kind + ".csv"))) << kind;
}

TEST_F(Logs, ARecorderThatLosesItsTerminalFinishesItsFile) {
  const std::string file = path("lost.mcap");
  ASSERT_EQ(shell("bash -c '" + (kControl + ("record --mcap --out " + file)) +
                  " & recorder=$!; sleep 1; kill -HUP $recorder; wait $recorder'"),
            0)
      << output_;
  EXPECT_NE(output_.find("SW.elbow.STATE: "), std::string::npos) << output_;
  EXPECT_TRUE(read_text_file(file).ends_with("\x89MCAP0\r\n")) << "the end of a whole file";
}

TEST_F(Logs, ALogOfLcmLoggerIsReadAsWell) {
  ASSERT_EQ(shell("bash -c 'lcm-logger --quiet -c \"SW.*\" " + path("logger.lcm") +
                  " & logger=$!; sleep 1; kill -INT $logger; wait $logger; true'"),
            0)
      << output_;
  ASSERT_EQ(shell(std::string(kControl) + "export " + path("logger.lcm") + " --out " + path("a.csv")), 0)
      << output_;
  EXPECT_NE(output_.find("elbow: "), std::string::npos) << output_;
}

TEST_F(Logs, APlainReplayIsRefusedByTheDaemonThatHeardTheOriginal) {
  record("a.lcm", {"move elbow 0.1 --wait", "move elbow 0.2 --wait"});
  ASSERT_EQ(ctl("move elbow 0 --wait"), 0) << output_;
  ASSERT_TRUE(client_->wait_for_timing());
  const auto refused = [&] {
    const auto& rejects = client_->timing()->rejects;
    return rejects[static_cast<int>(Reason::kOldSequence)] + rejects[static_cast<int>(Reason::kTooOld)];
  };
  const auto before = refused();
  ASSERT_EQ(shell("timeout 60 lcm-logplayer -s 5 -e \"SW.elbow.SETPOINT\" " + path("a.lcm")), 0) << output_;
  EXPECT_NEAR(position_rad(), 0.0, 1e-3);
  ASSERT_TRUE(client_->wait_for_timing());
  ASSERT_TRUE(client_->wait_for_timing());
  EXPECT_GE(refused(), before + 2);
}

TEST_F(Logs, APlainReplayIsRefusedByALaterDaemon) {
  record("a.lcm", {"move elbow 0.1 --wait"});
  start();
  ASSERT_EQ(shell("timeout 60 lcm-logplayer -s 5 -e \"SW.elbow.SETPOINT\" " + path("a.lcm")), 0) << output_;
  EXPECT_NEAR(position_rad(), 0.0, 1e-3);
  EXPECT_TRUE(daemon_->wait_for_log("another session", std::chrono::seconds(5))) << daemon_->log();
}

TEST_F(Logs, PlayMovesTheJointAgainWithAKeyAndNotWithout) {
  record("a.lcm", {"move elbow 0.1 --wait", "move elbow 0.2 --wait"});
  start();  // a later session of the daemon
  EXPECT_EQ(shell(std::string(kControl) + "play " + path("a.lcm") + " --joint elbow"), 2) << output_;
  EXPECT_NEAR(position_rad(), 0.0, 1e-3);
  EXPECT_EQ(ctl("play " + path("a.lcm") + " --joint elbow"), 0) << output_;
  EXPECT_TRUE(client_->wait_for_state("elbow", [](const state_v1& state) {
    return std::abs(state.joint_position_rad - 0.2) < 1e-3;
  })) << position_rad();
  EXPECT_EQ(ctl("play " + path("a.lcm") + " --joint wrist"), 2) << output_;
}

TEST_F(Logs, PlaySendsTheVelocitiesAccelerationsAndLoadsOfARecordedStream) {
  EventLogFile log(path("stream.lcm"));
  for (int i = 0; i < 3; ++i) {
    setpoint_v1 sample{};
    sample.stream_id = 7;
    sample.begins_stream = i == 0 ? 1 : 0;
    sample.valid_for_s = 0.5;
    sample.position_rad = 0.001 * i;
    sample.velocity_rad_s = 0.0625;
    sample.acceleration_rad_s2 = 0.03125;
    sample.torque_Nm = -0.25;
    sample.load_inertia_kgm2 = 0.015625;
    sample.derivatives = 2;
    sample.at_cycle = 1'000'000'000;  // of the session of the recording
    log.add(1'000'000 + 20'000 * i, "SW.elbow.SETPOINT", sample);
  }
  record("a.lcm", {"play " + path("stream.lcm") + " --joint elbow"});
  ASSERT_EQ(shell(std::string(kControl) + "export " + path("a.lcm") + " --out " + path("csv")), 0) << output_;
  std::ifstream setpoints(path("csv/SW.elbow.SETPOINT.csv"));
  std::string line;
  std::getline(setpoints, line);
  int sent = 0;
  for (; std::getline(setpoints, line); ++sent)
    EXPECT_NE(line.find(",0.0625,0.03125,-0.25,0.015625,0,2,"), std::string::npos) << line;
  EXPECT_EQ(sent, 3);
}

TEST_F(Logs, PlayHoldsAndSaysWhyWhenTheDaemonRefuses) {
  record("a.lcm", {"move elbow 0.1 --wait"});
  ASSERT_EQ(ctl("disable elbow"), 0) << output_;
  EXPECT_EQ(ctl("play " + path("a.lcm") + " --joint elbow"), 1) << output_;
  EXPECT_NE(output_.find("not possible in this mode"), std::string::npos) << output_;
}

TEST_F(Logs, IdentifyHoldsOnCtrlCAndWhenItIsKilledTheJointStops) {
  const std::string identify =
      kControl + ("--key " + path("key") + " identify elbow --overwrite --out ") + path("i.lcm");
  EXPECT_EQ(shell("timeout --foreground --preserve-status -s INT 4 " + identify), 130) << output_;
  EXPECT_NE(output_.find("elbow holds where it stops"), std::string::npos) << output_;
  EXPECT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding));
  EXPECT_EQ(shell("timeout -s KILL 4 " + identify), 137) << output_;
  client_->forget_states();
  EXPECT_TRUE(client_->wait_for_state("elbow", [](const state_v1& state) {
    return state.mode == static_cast<std::int32_t>(Mode::kHolding) &&
           (state.notices & static_cast<std::int32_t>(Notice::kSetpointExpired)) != 0;
  })) << "the stream must have expired";
}

TEST_F(Logs, IdentifyMovesNothingUnlessEverythingIsInOrder) {
  const double at_rad = position_rad();
  EXPECT_EQ(ctl("identify elbow --out " + path("i.lcm") + " --range_rad -4 1"), 2) << output_;
  EXPECT_NE(output_.find("-3.2 to 3.2"), std::string::npos) << output_;
  EXPECT_EQ(ctl("identify elbow --out " + path("i.lcm") + " --dry-run"), 0) << output_;
  EXPECT_FALSE(std::filesystem::exists(path("i.lcm")));
  ASSERT_EQ(ctl("disable elbow"), 0) << output_;
  EXPECT_EQ(ctl("identify elbow --out " + path("i.lcm")), 1) << output_;
  EXPECT_NE(output_.find("not holding"), std::string::npos) << output_;
  EXPECT_EQ(position_rad(), at_rad);
}

}  // namespace
}  // namespace strainwave::testing
