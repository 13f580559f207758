// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/acting.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <thread>
#include <vector>

#include "client/protocol/key_file.h"
#include "lcmtypes/signing.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

using Json = nlohmann::json;

constexpr Acting::Page kTab{1, true};
constexpr Acting::Page kOtherTab{2, true};
constexpr Acting::Page kForeignPage{3, false};

class ActingTest : public ::testing::Test {
 protected:
  struct Sent {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  ActingTest() : key_(write_new_key(folder_.path() / "key", Role::kOperator, "bench").key) {
    for (const char* joint : {"elbow", "knee"}) {
      state_v1 state{};
      state.session_id = 42;
      state.challenge = 7;
      state.joint_position_rad = 0.5;
      state.link_position_rad = std::numeric_limits<double>::quiet_NaN();
      fleet_.take({"SW", joint, "STATE"}, state, 0.0);
    }
    limits_v1 limits{};
    limits.position_min_rad = -2.0;
    limits.position_max_rad = 2.0;
    limits.speed_limit_rad_s = 4.0;
    limits.acceleration_rad_s2 = limits.deceleration_rad_s2 = 30.0;
    fleet_.take({"SW", "elbow", "LIMITS"}, limits, 0.0);
  }

  void take(const Acting::Page& page, Json order) {
    order["op"] = "act";
    acting_.take(page, read_page_order(order), now_s_);
  }
  void open(const Acting::Page& page) { take(page, {{"action", "open"}, {"token", acting_.token()}}); }
  static Json order(const std::string& action, const std::string& joint = "SW.elbow") {
    return {{"action", action}, {"joint", joint}, {"session_id", "42"}, {"challenge", "9223372036854775807"}};
  }
  static Json jog(int number, double velocity_rad_s, const std::string& joint = "SW.elbow") {
    Json json = order("jog", joint);
    json["jog"] = number;
    json["velocity_rad_s"] = velocity_rad_s;
    return json;
  }
  void tick(double seconds) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += Acting::kTick_s;
      acting_.tick(now_s_);
    }
  }
  /// The daemon's answer to the latest message.
  void acknowledge(Reason reason = Reason::kAccepted) {
    ack_v1 ack{};
    visit_latest([&](const auto& message) {
      ack.sender_id = message.sender_id;
      ack.sequence = message.sequence;
    });
    ack.accepted = reason == Reason::kAccepted ? 1 : 0;
    ack.reason = static_cast<std::int32_t>(reason);
    const auto name = parse_channel(sent_.back().channel);
    acting_.take({name->prefix, name->joint, "ACK"}, ack);
  }
  template <typename Visit>
  void visit_latest(const Visit& visit) const {
    if (const auto command = decode_exactly<command_v1>(sent_.back().bytes)) return visit(*command);
    visit(*decode_exactly<setpoint_v1>(sent_.back().bytes));
  }
  std::vector<Action> actions(const std::string& channel = "SW.elbow.COMMAND") const {
    std::vector<Action> found;
    for (const Sent& sent : sent_)
      if (sent.channel == channel)
        found.push_back(static_cast<Action>(decode_exactly<command_v1>(sent.bytes)->action));
    return found;
  }
  std::vector<setpoint_v1> setpoints() const {
    std::vector<setpoint_v1> found;
    for (const Sent& sent : sent_)
      if (const auto setpoint = decode_exactly<setpoint_v1>(sent.bytes)) found.push_back(*setpoint);
    return found;
  }
  bool signed_by_key(const Sent& sent) const { return verify(sent.channel, key_, sent.bytes); }
  /// The last text that `page` got; empty: none.
  Json said(const Acting::Page& page) const {
    return texts_.contains(page.number) ? texts_.at(page.number) : Json();
  }
  void begin_jog(const Acting::Page& page, int number = 1) {
    open(page);
    take(page, jog(number, 0.2));
    ASSERT_EQ(setpoints().size(), 1U) << said(page);
    acknowledge();
  }

  TemporaryFolder folder_;
  PublicKey key_;
  Fleet fleet_;
  std::vector<Sent> sent_;
  std::map<std::uint64_t, Json> texts_;
  double now_s_ = 100.0;
  Acting acting_{folder_.path() / "key", fleet_,
                 [this](const std::string& channel, std::span<const std::uint8_t> bytes) {
                   sent_.push_back({channel, {bytes.begin(), bytes.end()}});
                 },
                 [this](std::uint64_t page, const std::string& text) { texts_[page] = Json::parse(text); }};
};

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
  EXPECT_EQ(said(kTab)["text"], "SW.elbow: enable: refused, another client has the joint");
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

TEST_F(ActingTest, StopsEveryJointWithoutATokenAndCountsTheAnswers) {
  take(kTab, {{"action", "stop"}, {"joints", {"SW.knee", "left.unheard", "nonsense", 7}}});
  EXPECT_EQ(actions("SW.elbow.COMMAND"), std::vector{Action::kDisable});
  EXPECT_EQ(actions("SW.knee.COMMAND"), std::vector{Action::kDisable});
  EXPECT_EQ(actions("left.unheard.COMMAND"), std::vector{Action::kDisable});
  EXPECT_EQ(sent_.size(), 3U);
  EXPECT_EQ(said(kTab)["text"], "stop sent to 3 joints");
}

TEST_F(ActingTest, SendsEveryStopOfAFloodButRepeatsABoundedNumber) {
  constexpr std::size_t kStops = 8;
  for (std::size_t stop = 0; stop < kStops; ++stop) {
    Json names = Json::array();
    for (std::size_t i = 0; i < PageOrder::kMostJoints; ++i)
      names.push_back("left.j" + std::to_string(stop * PageOrder::kMostJoints + i));
    take(kTab, {{"action", "stop"}, {"joints", names}});
  }
  EXPECT_GE(sent_.size(), kStops * PageOrder::kMostJoints);
  sent_.clear();
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // a stop is repeated after half a second
  acting_.tick(now_s_);
  EXPECT_GT(sent_.size(), 0U);
  EXPECT_LE(sent_.size(), Acting::kMostOpen + 2 * PageOrder::kMostJoints);
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
  for (const Json& asked :
       {Json::object(), order("fly"), Json{{"action", "enable"}}, order("enable", "elbow"),
        Json{{"action", 7}}, Json{{"action", "stop"}, {"joints", 7}}}) {
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
  take(kTab, jog(1, 0.2));  // what was delayed on its way
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

TEST_F(ActingTest, JogsNoFasterThanItsShareOfTheSpeedLimitAndNotWithoutLimits) {
  open(kTab);
  take(kTab, jog(1, 0.41));
  EXPECT_EQ(said(kTab)["refused"], true);
  take(kTab, jog(2, -std::numeric_limits<double>::infinity()));
  take(kTab, jog(3, 0.2, "SW.knee"));
  EXPECT_EQ(said(kTab)["text"], "SW.knee: jog: refused, its state and limits have not come yet");
  EXPECT_TRUE(sent_.empty());
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
  EXPECT_EQ(said(kTab)["text"], "SW.elbow: jog ended: refused, another client has the joint");
}

}  // namespace
}  // namespace strainwave
