// SPDX-License-Identifier: BSD-3-Clause
// A client with a valid key orders a joint that another client owns, over LCM with the real daemon.
#include "tests/adversary/signed_daemon.h"

namespace strainwave::testing {
namespace {

/// The default of security.lease_s, twice as long for a busy host.
constexpr std::chrono::seconds kLongerThanALease{6};

class SecondOwner : public SignedDaemonTest {
 protected:
  void SetUp() override {
    start("");
    owner_.emplace();
    intruder_.emplace();
    bring_to_hold(*owner_);
    ASSERT_TRUE(intruder_->wait_for_state("elbow", [](const state_v1&) { return true; }));
  }
  Answer owner_moves(double position_rad) {
    return send(*owner_, "SETPOINT", owner_->make_setpoint("elbow", position_rad));
  }
  Answer intruder_moves(double position_rad) {
    return send(*intruder_, "SETPOINT", intruder_->make_setpoint("elbow", position_rad), operator_key_);
  }
  Answer intruder_orders(Action action) {
    return send(*intruder_, "COMMAND", intruder_->make_command("elbow", action), operator_key_);
  }

  std::optional<TestClient> owner_;
  std::optional<TestClient> intruder_;
};

TEST_F(SecondOwner, IsRefusedWhileTheFirstOneSpeaks) {
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(owner_moves(0.1).accepted);
    const Answer move = intruder_moves(1.0);
    EXPECT_EQ(move.reason, Reason::kNotOwner) << move.text;
  }
  owner_->pump(std::chrono::milliseconds(500));
  EXPECT_EQ(owner_->state("elbow")->owner_id, owner_->sender_id());
  EXPECT_NEAR(owner_->state("elbow")->joint_position_rad, 0.1, 1e-2);
}

TEST_F(SecondOwner, MayStopTheJointAllTheSame) {
  ASSERT_TRUE(owner_moves(0.1).accepted);
  EXPECT_TRUE(intruder_orders(Action::kHold).accepted);
  EXPECT_TRUE(intruder_orders(Action::kDisable).accepted);
  EXPECT_TRUE(intruder_->wait_for_mode("elbow", Mode::kOff)) << daemon_->log();
}

// The owner moves and the other client holds at the same instant. Whichever order comes first, the joint holds.
TEST_F(SecondOwner, WhoHoldsTheJointIsNotOverruledByAMoveThatWasOrderedBefore) {
  ASSERT_TRUE(owner_moves(0.1).accepted);
  for (int i = 0; i < 10; ++i) {
    owner_->pump(std::chrono::milliseconds(300));
    const setpoint_v1 move = owner_->make_setpoint("elbow", i % 2 == 0 ? 0.6 : 0.1);
    ASSERT_TRUE(intruder_orders(Action::kHold).accepted);
    const Answer overtaken = send(*owner_, "SETPOINT", move);
    EXPECT_EQ(overtaken.reason, Reason::kSuperseded) << overtaken.text;
  }
  owner_->pump(std::chrono::milliseconds(300));
  EXPECT_EQ(owner_->state("elbow")->mode, static_cast<std::int32_t>(Mode::kHolding));
  EXPECT_NEAR(owner_->state("elbow")->joint_position_rad, 0.1, 1e-2);
}

// Two programs run one after the other. The second one reads a state that is newer than the stop acknowledged to the first.
TEST_F(SecondOwner, MayEnableTheJointOnceAnotherProgramsDisableIsAnswered) {
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(intruder_orders(Action::kDisable).accepted) << i;
    TestClient program;
    const Answer enabled = send(program, "COMMAND", program.make_command("elbow", Action::kEnable));
    EXPECT_NE(enabled.reason, Reason::kSuperseded) << i << enabled.text;
    EXPECT_NE(enabled.reason, Reason::kTooOld) << i << enabled.text;
  }
}

TEST_F(SecondOwner, MayNotTakeOverUnlessHeIsAnEngineer) {
  ASSERT_TRUE(owner_moves(0.1).accepted);
  EXPECT_EQ(intruder_orders(Action::kTakeOver).reason, Reason::kRoleNotAllowed);
  EXPECT_EQ(intruder_moves(1.0).reason, Reason::kNotOwner);
}

TEST_F(SecondOwner, WhoIsAnEngineerTakesOverAndTheFirstOneIsRefused) {
  owner_->pump(kLongerThanALease);
  ASSERT_TRUE(intruder_moves(0.1).accepted) << "now he is the first";
  const Answer taken = send(*owner_, "COMMAND", owner_->make_command("elbow", Action::kTakeOver));
  ASSERT_TRUE(taken.accepted) << taken.text;
  EXPECT_EQ(intruder_moves(1.0).reason, Reason::kNotOwner);
  EXPECT_TRUE(owner_moves(0.2).accepted);
}

TEST_F(SecondOwner, MayMoveTheJointWhenTheFirstOneHasBeenSilentForTheLease) {
  ASSERT_TRUE(owner_moves(0.1).accepted);
  ASSERT_EQ(intruder_moves(0.3).reason, Reason::kNotOwner);
  intruder_->pump(kLongerThanALease);
  EXPECT_EQ(intruder_->state("elbow")->owner_id, 0);
  const Answer move = intruder_moves(0.3);
  EXPECT_TRUE(move.accepted) << move.text;
  EXPECT_TRUE(intruder_->wait_for_state(
      "elbow", [](const state_v1& state) { return std::abs(state.joint_position_rad - 0.3) < 1e-2; }));
  EXPECT_EQ(owner_moves(0.0).reason, Reason::kNotOwner) << "now he is the second";
}

}  // namespace
}  // namespace strainwave::testing
