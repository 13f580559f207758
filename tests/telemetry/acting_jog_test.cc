// SPDX-License-Identifier: BSD-3-Clause
// Jogs of the page (telemetry/acting.h).
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/telemetry/acting_fixture.h"

namespace strainwave {
namespace {

TEST_F(ActingTest, JogsOnlyAsLongAsThePageGoesOnAskingThenHolds) {
  begin_jog(kTab);
  for (int i = 0; i < 10; ++i) {
    take(kTab, jog(1, 0.2));
    tick(0.1);
  }
  const std::vector<setpoint_v1> samples = setpoints();
  ASSERT_GT(samples.size(), 40U);
  EXPECT_EQ(samples.front().begins_stream, 1);
  EXPECT_EQ(samples.front().position_rad, 0.5);
  EXPECT_NEAR(samples.back().position_rad, 0.5 + 0.2 * 1.0, 0.01);
  for (const setpoint_v1& sample : samples) EXPECT_LE(sample.valid_for_s, Acting::kJogLasts_s);
  EXPECT_TRUE(signed_by_key(sent_.back()));
  EXPECT_TRUE(actions().empty());
  tick(Acting::kJogLasts_s + 2.0 * Acting::kTick_s);
  EXPECT_EQ(actions(), std::vector{Action::kHold});
  const std::size_t sent = setpoints().size();
  take(kTab, jog(1, 0.2));  // a delayed message of the ended jog
  tick(0.2);
  EXPECT_EQ(setpoints().size(), sent) << "an ended jog does not begin again";
}

TEST_F(ActingTest, HoldsWhenTheButtonIsReleasedOrThePageIsGone) {
  begin_jog(kTab);
  take(kTab, {{"action", "jog-end"}, {"jog", 1}});
  EXPECT_EQ(actions(), std::vector{Action::kHold});
  tick(0.1);
  EXPECT_EQ(setpoints().size(), 1U);
  sent_.clear();
  begin_jog(kTab, 2);
  acting_.forget(kTab.number);
  EXPECT_EQ(actions(), std::vector{Action::kHold});
  sent_.clear();
  take(kTab, order("enable"));
  EXPECT_TRUE(sent_.empty()) << "a new connection shows its token anew";
}

TEST_F(ActingTest, LetsOnePageJogAJoint) {
  begin_jog(kTab);
  open(kOtherTab);
  take(kOtherTab, jog(1, -0.2));
  EXPECT_EQ(said(kOtherTab)["text"], "SW.elbow: jog: refused, another page jogs this joint");
  take(kOtherTab, {{"action", "jog-end"}, {"jog", 1}});
  EXPECT_TRUE(actions().empty()) << "nor ends it by the other's number";
  tick(0.1);
  EXPECT_GT(setpoints().back().velocity_rad_s, 0.0);
  take(kOtherTab, order("hold"));
  tick(0.1);
  EXPECT_EQ(actions(), std::vector{Action::kHold}) << "a hold is anybody's";
  const std::size_t sent = setpoints().size();
  tick(0.1);
  EXPECT_EQ(setpoints().size(), sent);
}

TEST_F(ActingTest, JogsNoFasterThanItsShareOfTheSpeedLimit) {
  open(kTab);
  take(kTab, jog(1, 0.2));
  acknowledge();
  for (const double asked_rad_s : {4.0, -std::numeric_limits<double>::infinity()}) {
    take(kTab, jog(1, asked_rad_s));
    tick(0.2);
    EXPECT_NEAR(setpoints().back().velocity_rad_s, std::copysign(0.4, asked_rad_s), 1e-12);
  }
  for (const setpoint_v1& sample : setpoints()) EXPECT_LE(std::abs(sample.velocity_rad_s), 0.4);
}

TEST_F(ActingTest, JogsNotWithoutTheLimitsOfTheSessionThatThePageSaw) {
  open(kTab);
  take(kTab, jog(1, 0.2, "SW.knee"));
  EXPECT_EQ(said(kTab)["text"], "SW.knee: jog: refused, the joint's state and limits have not come yet");
  Json before_restart = jog(2, 0.2);
  before_restart["session_id"] = "41";
  take(kTab, before_restart);
  EXPECT_EQ(said(kTab)["text"],
            "SW.elbow: jog: refused, the joint's limits are of another session of the daemon");
  state_v1 restarted{};
  restarted.session_id = 43;
  fleet_.take({"SW", "elbow", "STATE"}, restarted, 0.0);
  for (const char* session : {"42", "43"}) {
    Json asked = jog(session[1], 0.2);
    asked["session_id"] = session;
    take(kTab, asked);
    EXPECT_EQ(said(kTab)["text"],
              "SW.elbow: jog: refused, the joint's limits are of another session of the daemon")
        << session;
  }
  EXPECT_TRUE(sent_.empty());
}

TEST_F(ActingTest, EndsAJogAfterItsOwnPauseAndCatchesNothingUp) {
  begin_jog(kTab);
  tick(0.1);
  const double before_rad = setpoints().back().position_rad;
  now_s_ += 0.8 * Acting::kJogLasts_s;
  take(kTab, jog(1, 0.2));
  acting_.tick(now_s_);
  EXPECT_LE(setpoints().back().position_rad, before_rad + 0.2 * 2.0 * Acting::kTick_s + 1e-12);
  now_s_ += 1.1 * Acting::kJogLasts_s;
  sent_.clear();
  take(kTab, jog(1, 0.2));  // the message waited while the program paused
  acting_.tick(now_s_);
  EXPECT_TRUE(setpoints().empty());
  EXPECT_EQ(actions(), std::vector{Action::kHold});
}

TEST_F(ActingTest, SendsNoSampleBeforeTheFirstIsAcceptedAndNoneAfterARefusal) {
  open(kTab);
  take(kTab, jog(1, 0.2));
  tick(0.1);
  EXPECT_EQ(setpoints().size(), 1U);
  acknowledge();
  tick(0.1);
  EXPECT_GT(setpoints().size(), 3U);
  acknowledge(Reason::kNotOwner);
  const std::size_t sent = sent_.size();
  tick(0.1);
  EXPECT_EQ(sent_.size(), sent) << "nor a hold, which would stop the joint's new owner";
  EXPECT_EQ(said(kTab)["text"], "SW.elbow: jog ended: refused, another client owns the joint");
}

}  // namespace
}  // namespace strainwave
