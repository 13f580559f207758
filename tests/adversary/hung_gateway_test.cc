// SPDX-License-Identifier: BSD-3-Clause
// A gateway that hangs while a joint moves. Messages sent to it are lost, and the daemon replaces it. Our programs repeat a stop for longer than the
// replacement takes.
#include <csignal>
#include <strainwave/command_v1.hpp>
#include <string>
#include <thread>

#include "client/protocol/client.h"
#include "client/protocol/orders.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {
namespace {

class HungGateway : public DaemonTest {
 protected:
  void SetUp() override {
    daemon_.emplace(folder_, configuration());
    client_.emplace();
    ASSERT_TRUE(client_->wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon_->log();
    ASSERT_TRUE(client_->load("elbow", shipped_table()).accepted);
    ASSERT_TRUE(client_->command("elbow", Action::kEnable).accepted);
    ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
    setpoint_v1 slow = client_->make_setpoint("elbow", kFar_rad);
    slow.speed_limit_rad_s = kSpeed_rad_s;
    ASSERT_TRUE(client_->send_and_wait("elbow", "SETPOINT", slow).accepted);
  }
  static constexpr double kFar_rad = 3.0;
  static constexpr double kSpeed_rad_s = 0.1;  // the motion takes 30 s

  std::optional<DaemonProcess> daemon_;
  std::optional<TestClient> client_;
};

TEST_F(HungGateway, DoesNotKeepAStopOfOurProgramsFromTheJoint) {
  Connection connection(kTestUrl);
  Client client(connection, {});
  client.wait_for_joint("elbow");
  const pid_t gateway = daemon_->gateway_pid();
  ASSERT_EQ(::kill(gateway, SIGSTOP), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // its last turn has ended
  EXPECT_NO_THROW(send_stop(client, "elbow", Action::kHold)) << daemon_->log();
  EXPECT_NE(daemon_->gateway_pid(), gateway);
  ASSERT_TRUE(client_->wait_for_mode("elbow", Mode::kHolding)) << daemon_->log();
  EXPECT_LT(client_->state("elbow")->joint_position_rad, 0.5 * kFar_rad);
}

}  // namespace
}  // namespace strainwave::testing
