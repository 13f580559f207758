// SPDX-License-Identifier: BSD-3-Clause
// System test of the real daemon on the simulated plant, over LCM.
#include <signal.h>

#include <cmath>

#include "lcmtypes/wire.h"
#include "tests/support/daemon_fixture.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// One encoder count at the joint.
constexpr double kCount_rad = 2.0 * 3.14159265358979323846 / 320000.0;

class DaemonSystem : public DaemonTest {
 protected:
  void start(const std::string& joint_extra = "") {
    daemon_.emplace(folder_, configuration(joint_extra));
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
  }
  void start_holding(const std::string& joint_extra = "") {
    start(joint_extra);
    const Answer loaded = client_->load("elbow", shipped_table());
    ASSERT_TRUE(loaded.accepted) << loaded.text;
    ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted);
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
  }

  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
};

TEST_F(DaemonSystem, TracksMovesWhileTheTemperatureRises) {
  start_holding("[joint.simulated]\nambient_temperature_C = \"steps:-10,5,0.5,11\"\n");
  for (const double target_rad : {0.001, 0.01, 0.1, 1.0}) {
    ASSERT_TRUE(client_->move("elbow", target_rad).accepted);
    ASSERT_TRUE(client_->wait_for_state("elbow",
                                        [&](const state_v1& state) {
                                          return state.mode == static_cast<std::int32_t>(Mode::kHolding) &&
                                                 std::abs(state.joint_position_rad - target_rad) <=
                                                     kCount_rad;
                                        }))
        << "at " << target_rad << " rad the joint is at " << client_->state("elbow")->joint_position_rad;
  }
  EXPECT_TRUE(client_->wait_for_state("elbow",
                                      [](const state_v1& state) { return state.temperature_used_C > 40.0; }));
  const state_v1 state = *client_->state("elbow");
  double sum = 0.0;
  for (int i = 0; i < state.rule_count; ++i) sum += state.temperature_weights[i];
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST_F(DaemonSystem, SaysThatAMessageIsOfAnotherVersion) {
  start();
  ASSERT_TRUE(client_->wait_for_timing());
  const std::int64_t rejected = client_->timing()->rejects[static_cast<int>(Reason::kMalformed)];
  std::vector<std::uint8_t> older = encode(client_->make_setpoint("elbow", 0.1));
  ++older[0];  // changes the type's fingerprint
  ASSERT_EQ(
      client_->lcm().publish("SW.elbow.SETPOINT", older.data(), static_cast<unsigned int>(older.size())), 0);
  ASSERT_TRUE(client_->wait_for_timing());
  ASSERT_TRUE(client_->wait_for_timing());
  EXPECT_EQ(client_->timing()->rejects[static_cast<int>(Reason::kMalformed)], rejected + 1);
  EXPECT_NE(daemon_->log().find("message of another version on SW.elbow.SETPOINT"), std::string::npos)
      << daemon_->log();
}

TEST_F(DaemonSystem, RefusesATableWhoseGainWasMadeUnstable) {
  start();
  GainTable table = shipped_table();
  table.primary.F[1][1] = -table.primary.F[1][1];
  const Answer answer = client_->load("elbow", table);
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.reason, Reason::kTableNotCertified) << answer.text;
  EXPECT_EQ(client_->command("elbow", Action::kEnable).reason, Reason::kNoTable);
}

TEST_F(DaemonSystem, RefusesATableForAnotherInertiaOrPeriod) {
  start();
  GainTable heavier = shipped_table();
  heavier.plant.inertia_kgm2 *= 1.5;
  EXPECT_EQ(client_->load("elbow", heavier).reason, Reason::kTableIdentity);
  GainTable slower = shipped_table();
  slower.plant.period_s *= 2.0;
  EXPECT_EQ(client_->load("elbow", slower).reason, Reason::kTablePeriod);
}

TEST_F(DaemonSystem, RefusesATableWhileMovingAndKeepsMoving) {
  start_holding();
  ASSERT_TRUE(client_->move("elbow", 3.0).accepted);
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kTracking));
  EXPECT_EQ(client_->load("elbow", shipped_table()).reason, Reason::kMoving);
  EXPECT_TRUE(client_->wait_for_state(
      "elbow", [](const state_v1& state) { return std::abs(state.joint_position_rad - 3.0) <= kCount_rad; }));
}

TEST_F(DaemonSystem, RefusesSetpointsThatAreNotNumbersOrOutOfRange) {
  start_holding();
  EXPECT_EQ(client_->move("elbow", std::nan("")).reason, Reason::kNotFinite);
  EXPECT_EQ(client_->move("elbow", 1e9).reason, Reason::kOutOfRange);
  EXPECT_EQ(client_->move("elbow", 0.1, -1.0).reason, Reason::kOutOfRange);
  client_->forget_states();
  client_->pump(milliseconds(100));
  for (const state_v1& state : client_->history("elbow")) EXPECT_EQ(state.setpoint_position_rad, 0.0);
}

TEST_F(DaemonSystem, AnswersAResentOrderTheSameWayAndObeysItOnce) {
  start_holding();
  const setpoint_v1 move = client_->make_setpoint("elbow", 0.01);
  EXPECT_TRUE(client_->send_and_wait("elbow", "SETPOINT", move).accepted);
  ASSERT_TRUE(client_->move("elbow", 0.02).accepted);
  setpoint_v1 late = move;
  EXPECT_TRUE(client_->send_and_wait("elbow", "SETPOINT", late).accepted);  // the first answer is still known
  EXPECT_TRUE(client_->wait_for_state("elbow", [](const state_v1& state) {
    return state.mode == static_cast<std::int32_t>(Mode::kHolding) &&
           std::abs(state.joint_position_rad - 0.02) < 1e-4;
  }));
}

TEST_F(DaemonSystem, SaysHowToGoOnWhenItRefuses) {
  start();
  EXPECT_NE(client_->move("elbow", 0.1).text.find("enable it first"), std::string::npos);
  EXPECT_NE(client_->command("elbow", Action::kEnable).text.find("load a gain table"), std::string::npos);
}

TEST_F(DaemonSystem, StopsTheJointAndEndsCleanlyOnSigterm) {
  start_holding();
  ASSERT_TRUE(client_->move("elbow", 3.0).accepted);
  ASSERT_TRUE(client_->wait_for_state(
      "elbow", [](const state_v1& state) { return state.joint_velocity_rad_s > 1.0; }));
  client_->forget_states();
  daemon_->signal(SIGTERM);
  client_->pump(milliseconds(1500));
  EXPECT_EQ(daemon_->wait_for_end(seconds(10)), 0) << daemon_->log();
  ASSERT_FALSE(client_->history("elbow").empty());
  bool stopped_in_between = false;
  for (const state_v1& state : client_->history("elbow"))
    stopped_in_between = stopped_in_between || state.mode == static_cast<std::int32_t>(Mode::kStopping);
  EXPECT_TRUE(stopped_in_between);
  EXPECT_LT(client_->history("elbow").back().joint_position_rad, 2.9);
  EXPECT_NE(daemon_->log().find("every joint is at rest"), std::string::npos);
}

TEST_F(DaemonSystem, ASecondDaemonOnTheSamePrefixIsRefusedWithAdvice) {
  start();
  const auto other = folder_ / "other";
  std::filesystem::create_directory(other);
  DaemonProcess second(other, configuration());
  EXPECT_EQ(second.wait_for_end(seconds(10)), 2);
  EXPECT_NE(second.log().find("daemon.prefix"), std::string::npos) << second.log();
  EXPECT_TRUE(daemon_->running());
}

TEST_F(DaemonSystem, WithoutAMulticastRouteItWaitsForOneAndSaysWhatToDo) {
  if (!enter_private_network(false)) GTEST_SKIP() << "no network namespace allowed here";
  DaemonProcess daemon(folder_, configuration());
  ASSERT_TRUE(daemon.wait_for_log("waiting for LCM on", seconds(20))) << daemon.log();
  EXPECT_NE(daemon.log().find("ip route add 239.255.76.67/32"), std::string::npos) << daemon.log();
}

}  // namespace
}  // namespace strainwave::testing
