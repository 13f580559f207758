// SPDX-License-Identifier: BSD-3-Clause
// libstrainwave-client with a fake daemon over a real network. docs/client.md shows it with strainwaved.
#include "strainwave/joint.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "tests/client/protocol/running_daemon.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

class JointTest : public ::testing::Test {
 protected:
  Joint elbow(double timeout_s = 20.0) {
    return Joint("elbow", {.key = "", .lcm_url = own_url(), .timeout_s = timeout_s});
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  RunningDaemon daemon{own_url()};
};

TEST_F(JointTest, EnablesMovesAndTellsHowFarAwayItIs) {
  Joint joint = elbow();
  joint.enable();
  const Arrival arrival = joint.move(0.5);
  EXPECT_EQ(arrival.error_rad, 0.0);
  EXPECT_EQ(joint.state().joint_position_rad, 0.5);
  EXPECT_EQ(joint.state().mode, Mode::kHolding);
}

TEST_F(JointTest, SendsNothingForAnEnableOrAClearFaultOfWhatIsSo) {
  Joint joint = elbow();
  joint.enable();
  joint.clear_fault();
  daemon.stop();
  EXPECT_TRUE(daemon.daemon().heard().empty());
}

TEST_F(JointTest, ARefusalHasItsReasonAndTheDaemonsWords) {
  daemon.daemon().reason = Reason::kNotOwner;
  daemon.daemon().text = "somebody else's for 3 s";
  Joint joint = elbow();
  try {
    joint.move(0.5);
    FAIL() << "was not refused";
  } catch (const Refused& error) {
    EXPECT_EQ(error.reason(), Reason::kNotOwner);
    EXPECT_TRUE(has(error.what(), "elbow: move to 0.5 rad refused (31, ")) << error.what();
    EXPECT_TRUE(has(error.what(), "somebody else's for 3 s")) << error.what();
  }
}

TEST_F(JointTest, TellsOfAFaultByItsNumber) {
  daemon.daemon().state.fault = static_cast<std::int32_t>(Fault::kOverload);
  daemon.daemon().after_answer = [this] {
    daemon.daemon().state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  };
  Joint joint = elbow();
  try {
    joint.move(0.5);
    FAIL() << "did not fault";
  } catch (const Faulted& error) {
    EXPECT_EQ(error.fault(), Fault::kOverload);
    EXPECT_STREQ(error.what(),
                 "elbow: faulted (24: load too large); once the cause is gone: Joint::clear_fault()");
  }
}

TEST_F(JointTest, SaysThatAStopWasSentWhenNothingAnswers) {
  Joint joint = elbow(1.0);
  EXPECT_EQ(joint.state().mode, Mode::kHolding);
  daemon.stop();
  const std::string words = testing::refusal_of<NoAnswer>([&] { joint.disable(); });
  EXPECT_TRUE(has(words, "the stop was sent 8 times, and no answer came")) << words;
  EXPECT_TRUE(has(words, ": no state for 4.")) << words;
  EXPECT_FALSE(has(words, "publishes its state")) << words;
}

TEST_F(JointTest, WhatIsWrongIsRefusedBeforeAnythingIsSent) {
  Joint joint = elbow();
  EXPECT_TRUE(has(testing::refusal_of<InvalidInput>([] { Joint("el bow"); }), "name = 'el bow': 1 to 24 "));
  EXPECT_TRUE(has(testing::refusal_of<InvalidInput>([] { Joint("a", {.prefix = ""}); }), "prefix = ''"));
  EXPECT_TRUE(has(testing::refusal_of<InvalidInput>([] { Joint("a", {.timeout_s = 0.0}); }),
                  "a: timeout_s = 0: 0.1 to "));
  EXPECT_TRUE(
      has(testing::refusal_of<InvalidInput>([] { Joint("a", {.key = "/nowhere/key"}); }), "/nowhere/key"));
  EXPECT_TRUE(
      has(testing::refusal_of<InvalidInput>([&] { joint.move(std::nan("")); }), "elbow: position_rad = nan"));
  EXPECT_TRUE(has(testing::refusal_of<InvalidInput>(
                      [&] { joint.move({.position_rad = 0.1, .speed_limit_rad_s = -1.0}); }),
                  "speed_limit_rad_s = -1"));
  EXPECT_TRUE(has(testing::refusal_of<InvalidInput>([&] { joint.stream({.ahead_s = 2.0}); }), "ahead_s = 2"));
  daemon.stop();
  EXPECT_TRUE(daemon.daemon().heard().empty());
}

TEST_F(JointTest, KnowsTheLatestStateHoweverLongNobodyAsked) {
  Joint joint = elbow();
  const std::int64_t first = joint.state().cycle;
  // More states than the system's socket buffer or a queue of the client would keep.
  constexpr std::int64_t kManyStates = 5000;
  while (daemon.cycle() < first + kManyStates) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::int64_t least = daemon.cycle() - 2000;
  EXPECT_GT(joint.state().cycle, least);
}

TEST_F(JointTest, HandsOverEveryStateInOrder) {
  Joint joint = elbow();
  std::vector<std::int64_t> cycles;
  joint.states(0.2, [&](const State& state) { cycles.push_back(state.cycle); });
  ASSERT_GT(cycles.size(), 1U);
  for (std::size_t i = 1; i < cycles.size(); ++i) EXPECT_GT(cycles[i], cycles[i - 1]);
}

TEST_F(JointTest, OfTheSameNameIsAnsweredWhileAnotherWaits) {
  daemon.daemon().obeys_moves = false;
  daemon.daemon().state.mode = static_cast<std::int32_t>(Mode::kTracking);  // the joint never arrives
  std::atomic<int> answers{0};
  daemon.daemon().after_answer = [&] { ++answers; };
  Joint moving = elbow(1.0);
  Joint other = elbow();
  std::atomic<bool> ended{false};
  std::string words;
  std::thread waiting([&] {
    words = testing::refusal_of<NoAnswer>([&] { moving.move(0.0); });
    ended = true;
  });
  while (answers == 0 && !ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  other.release();
  EXPECT_FALSE(ended);
  daemon.stop();
  waiting.join();
  EXPECT_TRUE(has(words, "lost contact with strainwaved")) << words;
}

}  // namespace
}  // namespace strainwave
