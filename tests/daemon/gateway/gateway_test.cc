// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/gateway.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <strainwave/command_v1.hpp>
#include <string>

#include "lcmtypes/multicast_check.h"
#include "strainwave/vocabulary.h"
#include "tests/support/own_port.h"

namespace strainwave {
namespace {

const std::string kUrl = testing::own_url();

class GatewayTurn : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto problem = find_multicast_problem(kUrl)) GTEST_SKIP() << *problem;
    ASSERT_EQ(::pipe2(wake_, O_NONBLOCK), 0);
    outbound_->prefix = FixedString<32>("SW");
    outbound_->lcm_url = FixedString<256>(kUrl);
    outbound_->session_id = 7;
    outbound_->joint_count = 1;
    outbound_->joint_names[0] = FixedString<32>("elbow");
    gateway_ = std::make_unique<Gateway>(*outbound_, *inbound_, wake_[1]);
    ASSERT_TRUE(gateway_->good()) << gateway_->problem();
    for (auto* subscription : {listener_.subscribeFunction("SW.elbow.STATE", &count, &states_),
                               listener_.subscribeFunction("SW.elbow.ACK", &count, &answers_)})
      subscription->setQueueCapacity(0);
  }

  void TearDown() override {
    ::close(wake_[0]);
    ::close(wake_[1]);
  }

  /// States that the core wrote while the gateway had no processor time.
  void write_states(std::uint64_t how_many) {
    for (std::uint64_t i = 0; i < how_many; ++i) outbound_->states.write(StateRecord{});
  }

  void listen() {
    while (listener_.handleTimeout(20) > 0) continue;
  }

  static void count(const lcm::ReceiveBuffer*, const std::string&, int* messages) { ++*messages; }

  std::unique_ptr<OutboundMemory> outbound_ = std::make_unique<OutboundMemory>();
  std::unique_ptr<InboundMemory> inbound_ = std::make_unique<InboundMemory>();
  std::unique_ptr<Gateway> gateway_;
  lcm::LCM listener_{kUrl};
  int wake_[2] = {-1, -1};
  int states_ = 0;
  int answers_ = 0;
};

// Once, on a loaded machine, it published 8192 states before it looked for a stop, which took over two seconds. It was ended as hung.
TEST_F(GatewayTurn, EndsThoughManyStatesWait) {
  write_states(1000);
  gateway_->turn(0);
  listen();
  EXPECT_GT(states_, 0);
  EXPECT_LE(states_, 100);
}

TEST_F(GatewayTurn, HandsAStopOverAndAnswersBeforeTheStatesThatWait) {
  write_states(1000);
  gateway_->turn(0);
  command_v1 stop{};
  stop.action = static_cast<std::int32_t>(Action::kDisable);
  listener_.publish("SW.elbow.COMMAND", &stop);
  WireMessage answer;
  answer.channel = FixedString<64>("SW.elbow.ACK");
  answer.size = 8;
  outbound_->messages.write(answer);
  gateway_->turn(100);
  EXPECT_EQ(inbound_->stops.written.load(), 1U);
  listen();
  EXPECT_EQ(answers_, 1);
  EXPECT_LE(states_, 200);
}

TEST_F(GatewayTurn, PublishesEveryStateInTheEnd) {
  write_states(1000);
  for (int turn = 0; turn < 100; ++turn) {
    gateway_->turn(0);
    listen();
  }
  EXPECT_EQ(states_, 1000);
  EXPECT_EQ(inbound_->state_records_dropped.load(), 0U);
}

}  // namespace
}  // namespace strainwave
