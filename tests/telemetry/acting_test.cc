// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/acting.h"

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/telemetry/acting_fixture.h"

namespace strainwave {
namespace {

TEST_F(ActingTest, SignsAnOrderOfAPageThatShowedTheTokenAndQuotesWhatThePageSaw) {
  open(kTab);
  EXPECT_EQ(said(kTab)["open"], true);
  take(kTab, order("enable"));
  ASSERT_EQ(actions(), std::vector{Action::kEnable});
  const auto command = decode_exactly<command_v1>(sent_.back().bytes);
  EXPECT_EQ(command->session_id, 42);
  EXPECT_EQ(command->challenge, 9223372036854775807)
      << "not the latest challenge: it must come from the page";
  EXPECT_TRUE(signed_by_key(sent_.back()));
  acknowledge(Reason::kNotOwner);
  EXPECT_EQ(said(kTab)["text"], "SW.elbow: enable: refused, another client owns the joint");
  EXPECT_EQ(said(kTab)["refused"], true);
}

TEST_F(ActingTest, SendsNothingForAPageWithoutTheToken) {
  for (const std::string& token :
       {std::string(), std::string("00"), acting_.token() + "0", std::string(acting_.token().size(), '0')}) {
    take(kTab, {{"action", "open"}, {"token", token}});
    EXPECT_EQ(said(kTab)["open"], false);
    for (const Json& asked : {order("enable"), order("hold"), jog(1, 0.2)}) take(kTab, asked);
  }
  take(kTab, {{"action", "open"}});
  take(kTab, order("enable"));
  open(kOtherTab);
  take(kTab, order("enable"));
  EXPECT_TRUE(sent_.empty()) << "the token of one page is not another's";
  EXPECT_EQ(said(kTab)["refused"], true);
}

TEST_F(ActingTest, SendsNothingForAnotherServersPageEvenWithTheToken) {
  open(kForeignPage);
  for (const Json& asked : {order("enable"), order("hold"), jog(1, 0.2), order("stop")})
    take(kForeignPage, asked);
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(said(kForeignPage)["refused"], true);
}

TEST_F(ActingTest, StopsEveryJointThatIsHeardWithoutATokenAndNoOther) {
  take(kTab, {{"action", "stop"}, {"joints", {"SW.knee", "left.unheard", "nonsense", 7}}});
  EXPECT_EQ(actions("SW.elbow.COMMAND"), std::vector{Action::kDisable});
  EXPECT_EQ(actions("SW.knee.COMMAND"), std::vector{Action::kDisable});
  EXPECT_EQ(sent_.size(), 2U) << "a page does not make up joints";
  EXPECT_EQ(said(kTab)["text"], "stop sent to 2 joints");
  EXPECT_EQ(said(kTab)["refused"], false);
}

TEST_F(ActingTest, SaysThatAStopReachesNoJoint) {
  fleet_.forget_silent(2.0 * Fleet::kSilent_s);
  take(kTab, {{"action", "stop"}});
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(said(kTab)["refused"], true);
}

TEST_F(ActingTest, StopsAlsoTheJogOfAJointThatIsHeardNoMore) {
  begin_jog(kTab);
  fleet_.forget_silent(2.0 * Fleet::kSilent_s);
  sent_.clear();
  take(kOtherTab, {{"action", "stop"}});
  EXPECT_EQ(actions(), std::vector{Action::kDisable});
  tick(0.1);
  EXPECT_TRUE(setpoints().empty());
}

TEST_F(ActingTest, RepeatsOneStopOfAJointHoweverManyCame) {
  for (int stop = 0; stop < 100; ++stop) take(kTab, {{"action", "stop"}});
  EXPECT_EQ(sent_.size(), 2U * 100U);
  sent_.clear();
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // a stop is repeated after half a second
  acting_.tick(now_s_);
  EXPECT_EQ(sent_.size(), 2U);
}

TEST_F(ActingTest, SendsNoOrderAgainThatAStopOvertook) {
  open(kTab);
  for (const Json& asked : {order("enable"), jog(1, 0.2)}) {
    take(kTab, asked);
    const Sent overtaken = sent_.back();
    take(kTab, {{"action", "stop"}});
    sent_.clear();
    sent_.push_back(overtaken);
    acknowledge(Reason::kOldSequence);  // a refusal that makes the program resend pending orders
    tick(0.1);
    EXPECT_EQ(sent_.size(), 1U) << asked;
  }
}

TEST_F(ActingTest, StopsWithoutAKey) {
  std::filesystem::remove(folder_.path() / "key");
  open(kTab);
  take(kTab, order("enable"));
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(said(kTab)["refused"], true);
  take(kTab, order("stop"));
  EXPECT_EQ(actions(), std::vector{Action::kDisable});
}

TEST_F(ActingTest, AnswersNonsense) {
  open(kTab);
  for (const Json& asked : {Json::object(), order("fly"), Json{{"action", "enable"}},
                            order("enable", "elbow"), Json{{"action", 7}}}) {
    texts_.clear();
    take(kTab, asked);
    EXPECT_EQ(said(kTab)["op"], "acted") << asked;
  }
  Json rounded = order("enable");
  rounded["challenge"] = 9223372036854775807;
  sent_.clear();
  take(kTab, rounded);
  EXPECT_TRUE(sent_.empty()) << "a number may have been rounded on its way";
}

}  // namespace
}  // namespace strainwave
