// SPDX-License-Identifier: BSD-3-Clause
// An attacker on the path between client and daemon forwards, withholds and delays messages at will.
#include "tests/adversary/relay.h"
#include "tests/adversary/signed_daemon.h"

namespace strainwave::testing {
namespace {

/// Twice the lifetime of an order, and far shorter than the memory of challenges, so that the refusal is due to age.
constexpr std::int64_t kLong_cycles = 2'500;

class OnPathRelay : public SignedDaemonTest {
 protected:
  void SetUp() override {
    start("lcm_url = \"" + std::string(kInsideUrl) + "\"\n");
    relay_.emplace();
    client_.emplace();
    bring_to_hold(*client_);
  }
  void wait_cycles(std::int64_t cycles) {
    const std::int64_t from = client_->state("elbow")->cycle;
    ASSERT_TRUE(client_->wait_for_state(
        "elbow", [&](const state_v1& state) { return state.cycle > from + cycles; },
        std::chrono::seconds(180)));
  }
  /// Withholds `message` for kLong_cycles and then delivers it. Returns the daemon's answer.
  template <typename Message>
  Answer deliver_late(const char* kind, const Message& message) {
    relay_->keep_back(true);
    publish(*client_, kind, message);
    while (relay_->kept() == 0) client_->pump(std::chrono::milliseconds(5));
    wait_cycles(kLong_cycles);
    relay_->keep_back(false);
    relay_->deliver();
    return client_->wait_for_answer(message.sequence);
  }

  std::optional<Relay> relay_;
  std::optional<TestClient> client_;
};

TEST_F(OnPathRelay, CannotMoveTheJointWithAMoveThatHeKeptBack) {
  const double before_rad = client_->state("elbow")->joint_position_rad;
  const Answer late = deliver_late("SETPOINT", client_->make_setpoint("elbow", 0.5));
  EXPECT_FALSE(late.accepted);
  EXPECT_EQ(late.reason, Reason::kTooOld) << late.text;
  wait_cycles(500);
  EXPECT_EQ(client_->state("elbow")->mode, static_cast<std::int32_t>(Mode::kHolding));
  EXPECT_NEAR(client_->state("elbow")->joint_position_rad, before_rad, 1e-3);
  const Answer anew = send(*client_, "SETPOINT", client_->make_setpoint("elbow", 0.5));
  EXPECT_TRUE(anew.accepted) << anew.text;
}

TEST_F(OnPathRelay, CannotEnableAJointThatWasDisabledMeanwhile) {
  disable(*client_);
  const Answer late = deliver_late("COMMAND", client_->make_command("elbow", Action::kEnable));
  EXPECT_EQ(late.reason, Reason::kTooOld) << late.text;
  wait_cycles(500);
  EXPECT_EQ(client_->state("elbow")->mode, static_cast<std::int32_t>(Mode::kOff));
}

// Both moves are sent at once, so that neither is too old. A stop between them would already refuse the first one (stranger_test).
TEST_F(OnPathRelay, CannotDeliverAMoveAfterALaterOne) {
  relay_->keep_back(true);
  const setpoint_v1 move = client_->make_setpoint("elbow", 0.5);
  publish(*client_, "SETPOINT", move);
  while (relay_->kept() == 0) client_->pump(std::chrono::milliseconds(5));
  relay_->keep_back(false);
  ASSERT_TRUE(send(*client_, "SETPOINT", client_->make_setpoint("elbow", 0.1)).accepted);
  relay_->deliver();
  const Answer late = client_->wait_for_answer(move.sequence);
  EXPECT_TRUE(late.reason == Reason::kOldSequence || late.reason == Reason::kTooOld) << late.text;
  wait_cycles(1000);
  EXPECT_NEAR(client_->state("elbow")->joint_position_rad, 0.1, 1e-2);
}

}  // namespace
}  // namespace strainwave::testing
