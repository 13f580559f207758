// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/published_limits.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "strainwave/client_error.h"
#include "tests/client/protocol/fake_daemon.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

class PublishedLimitsTest : public ::testing::Test {
 protected:
  Connection connection{"memq://"};
  FakeDaemon daemon{connection, "SW", "elbow"};
  Client client{connection, {"SW", 0.2}};
  PublishedLimits limits{client, {"elbow"}};
};

TEST_F(PublishedLimitsTest, AreThoseThatCameBeforeAnybodyAsked) {
  daemon.limits.position_max_rad = 1.5;
  daemon.publish_limits();
  daemon.publish_state();
  EXPECT_EQ(limits.wait_for("elbow").position_max_rad, 1.5);
}

TEST_F(PublishedLimitsTest, OfADaemonThatWasStartedAnewAreNotThoseFromBefore) {
  daemon.publish_limits();
  daemon.publish_state();
  EXPECT_EQ(limits.wait_for("elbow").position_max_rad, 3.0);
  daemon.state.session_id = 78;
  daemon.publish_state();
  client.catch_up();
  const std::string refused = testing::refusal_of<NoAnswer>([&] { (void)limits.wait_for("elbow"); });
  EXPECT_EQ(refused, "elbow: its limits are not known: no state for 2.0 s");
  daemon.limits.position_max_rad = 2.0;
  daemon.publish_limits();
  EXPECT_EQ(limits.wait_for("elbow").position_max_rad, 2.0);
}

TEST_F(PublishedLimitsTest, MayComeLaterThanAnyAnswerBecauseTheyComeOnceASecond) {
  // Each state triggers the next one, for longer than the client's time-out.
  struct Playing {
    FakeDaemon& daemon;
    int rounds = 0;
    void on_state(const ReceivedMessage&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (++rounds < 80) return daemon.publish_state();
      daemon.publish_limits();
    }
  } playing{daemon};
  const Subscription states = connection.subscribe("SW\\.elbow\\.STATE", &Playing::on_state, &playing);
  daemon.publish_state();
  EXPECT_EQ(limits.wait_for("elbow").position_max_rad, 3.0);
}

}  // namespace
}  // namespace strainwave
