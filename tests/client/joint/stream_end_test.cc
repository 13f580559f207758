// SPDX-License-Identifier: BSD-3-Clause
// A stream ends by its close, by an exception, or because the joint or its daemon stops it.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "tests/client/joint/stream_fixture.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

using testing::StreamTest;

TEST_F(StreamTest, EndsInAHoldOnceItsLastSamplesTimeHasCome) {
  {
    auto stream = joint.stream();
    stream.put(0.0, 0.1);
    stream.put(0.2, 0.1);
  }
  const std::int64_t end = daemon.cycle();
  const auto setpoints = heard<setpoint_v1>();
  const auto commands = heard<command_v1>();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].action, static_cast<std::int32_t>(Action::kHold));
  EXPECT_GE(end, setpoints.back().at_cycle);
}

TEST_F(StreamTest, OfAJointThatHasFallenSilentIsClosedByAHoldThatIsSentOnce) {
  {
    Joint impatient{"elbow", {.key = "", .lcm_url = own_url(), .timeout_s = 0.5}};
    auto stream = impatient.stream();
    stream.put(0.0, 0.1);
    daemon.fall_silent();
    const std::string refused = testing::refusal_of<NoAnswer>([&] { stream.close(); });
    EXPECT_TRUE(refused.starts_with("elbow: the stop was sent 8 times, and no answer came: ")) << refused;
    EXPECT_NE(refused.find("no state for"), std::string::npos) << refused;
    EXPECT_NO_THROW(stream.close()) << "it is";
  }
  const auto commands = heard<command_v1>();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].action, static_cast<std::int32_t>(Action::kHold));
}

TEST_F(StreamTest, WhoseCloseFindsARefusalHoldsAndThenTellsIt) {
  daemon.daemon().after_answer = [this] {
    daemon.daemon().reason = daemon.daemon().heard().size() == 1 ? Reason::kOutOfRange : Reason::kAccepted;
  };
  auto stream = joint.stream({.ahead_s = 0.9});
  stream.put(0.0, 0.1);
  stream.put(0.01, 0.1);
  EXPECT_THROW(stream.close(), Refused);
  const auto commands = heard<command_v1>();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].action, static_cast<std::int32_t>(Action::kHold));
}

TEST_F(StreamTest, HoldsAtOnceAfterAnException) {
  struct Trouble {};
  try {
    auto stream = joint.stream({.ahead_s = 0.9});
    stream.put(0.0, 0.1);
    stream.put(0.3, 0.1);
    throw Trouble{};
  } catch (const Trouble&) {
  }
  const auto setpoints = heard<setpoint_v1>();
  const auto commands = heard<command_v1>();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].action, static_cast<std::int32_t>(Action::kHold));
  EXPECT_LT(daemon.cycle(), setpoints.back().at_cycle);
}

TEST_F(StreamTest, HoldsAfterARefusal) {
  daemon.daemon().after_answer = [this] { daemon.daemon().reason = Reason::kOutOfRange; };
  const auto ride = [this] {
    auto stream = joint.stream({.ahead_s = 0.9});
    for (int i = 0; i < 1000; ++i) stream.put(0.01 * i, 0.1);
  };
  EXPECT_THROW(ride(), Refused);
  const auto commands = heard<command_v1>();
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.back().action, static_cast<std::int32_t>(Action::kHold));
}

// The fake daemon ends the stream with each reason, while samples of the stream are still on their way.
class EndedStreamTest : public StreamTest, public ::testing::WithParamInterface<Reason> {};

TEST_P(EndedStreamTest, IsOverWhenItIsRefusedAndSaysWhy) {
  daemon.daemon().after_answer = [this] { daemon.daemon().reason = GetParam(); };
  auto stream = joint.stream();
  stream.put(0.0, 0.1);
  try {
    for (int i = 1; i < 1000; ++i) stream.put(0.01 * i, 0.1);
    FAIL() << "went on";
  } catch (const Refused& error) {
    EXPECT_EQ(error.reason(), GetParam());
    EXPECT_TRUE(std::string(error.what()).ends_with("; this stream is over; Joint::stream() opens a new one"))
        << error.what();
  }
  EXPECT_THROW(stream.put(20.0, 0.1), NotDone) << "over";
}
INSTANTIATE_TEST_SUITE_P(ForEachReason, EndedStreamTest,
                         ::testing::Values(Reason::kStreamEnded, Reason::kSuperseded, Reason::kWrongSession));

TEST_F(StreamTest, CountsLateAndOutdatedSamplesEachOnTheirOwn) {
  daemon.daemon().after_answer = [this] {
    const std::size_t orders = daemon.daemon().heard().size();
    daemon.daemon().reason = orders == 1   ? Reason::kTooOld
                             : orders == 2 ? Reason::kCycleIsOver
                             : orders == 3 ? Reason::kTooOld
                                           : Reason::kVelocitiesContradict;
    daemon.daemon().text = "velocity_rad_s is 57.3 times the rate, as if in deg/s";
  };
  auto stream = joint.stream();
  try {
    for (int i = 0; i < 1000; ++i) stream.put(0.01 * i, 0.1 + 0.001 * i, 5.73);
    FAIL() << "went on";
  } catch (const Refused& error) {
    EXPECT_EQ(error.reason(), Reason::kVelocitiesContradict);
    for (const char* part :
         {"as if in deg/s", "; 1 of its samples came late, 2 quoted an old state; this stream is over"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_EQ(stream.late(), 1);
  EXPECT_EQ(stream.outdated(), 2);
}

// A fake daemon that refuses all samples and says nothing about the reason until the joint has stopped.
class StoppedStreamTest : public StreamTest {
 protected:
  Stream begun() {
    auto stream = joint.stream({.ahead_s = 0.9, .valid_for_s = 10.0});
    stream.put(0.0, 0.1);
    return stream;
  }
  /// Expects the put that notices the end to throw an Error.
  template <typename Error>
  void expect_over(Stream& stream, const std::function<void(const Error&)>& look) {
    double t_s = 0.0;
    try {
      while (t_s < 10.0) stream.put(t_s += 0.01, 0.1);
      FAIL() << "went on";
    } catch (const Error& error) {
      look(error);
    }
    EXPECT_THROW(stream.put(20.0, 0.1), NotDone) << "over";
    for (const command_v1& command : heard<command_v1>()) ADD_FAILURE() << command.action << " was sent";
  }
};

TEST_F(StoppedStreamTest, ThrowsTheFaultThatEndedIt) {
  auto& played = daemon.daemon();
  played.after_answer = [&] {
    if (played.heard().size() > 1) played.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
    played.reason = Reason::kFaulted;
    played.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  };
  auto stream = begun();
  expect_over<Faulted>(stream,
                       [](const Faulted& error) { EXPECT_EQ(error.fault(), Fault::kFollowingError); });
}

// The new daemon counts its cycles from 0, so that the cycles of the samples would never come.
TEST_F(StoppedStreamTest, ThrowsThatTheDaemonWasRestartedAndWhatToDo) {
  auto& played = daemon.daemon();
  // Waits until the joint has this cycle. An older state would make every sample late.
  constexpr std::int64_t kCycle = 1'000'000'000;
  while (joint.state().cycle < kCycle) played.state.cycle = kCycle;
  played.after_answer = [&] {
    played.reason = Reason::kWrongSession;
    if (played.heard().size() < 2) return;
    played.state.session_id = 78;
    played.state.cycle = 0;
    played.state.mode = static_cast<std::int32_t>(Mode::kOff);
  };
  auto stream = begun();
  expect_over<NotDone>(stream, [](const NotDone& error) {
    EXPECT_STREQ(
        error.what(),
        "elbow: did not follow the stream to its end: the daemon was restarted, and the joint is off; "
        "enable it; Joint::stream() opens a new stream");
  });
}

TEST_F(StoppedStreamTest, ThrowsTheFaultThoughNoRefusalCame) {
  auto& played = daemon.daemon();
  played.after_answer = [&] {
    if (played.heard().size() > 1) played.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  };
  auto stream = begun();
  expect_over<Faulted>(stream, [](const Faulted&) {});
}

TEST_F(StoppedStreamTest, IsNotOverForALoadThatMayBeOfBefore) {
  auto& played = daemon.daemon();
  played.after_answer = [&] { played.show_yield(); };
  auto stream = begun();
  EXPECT_TRUE(stream.put(0.001, 0.1));
  EXPECT_TRUE(stream.put(0.002, 0.1));
  expect_over<Yielded>(stream, [](const Yielded&) {});
}

TEST_F(StoppedStreamTest, ThrowsTheRefusalOfAFaultThatSomebodyHasCleared) {
  daemon.daemon().after_answer = [this] { daemon.daemon().reason = Reason::kFaulted; };
  auto stream = begun();
  try {
    for (int i = 1; i < 1000; ++i) stream.put(0.01 * i, 0.1);
    FAIL() << "went on";
  } catch (const Refused& error) {
    EXPECT_EQ(error.reason(), Reason::kFaulted);
  }
}

TEST_F(StoppedStreamTest, ThrowsTheLoadThatTheJointYieldedTo) {
  auto& played = daemon.daemon();
  played.after_answer = [&] {
    if (played.heard().size() > 1) played.show_yield();
    played.reason = Reason::kStreamEnded;
  };
  auto stream = begun();
  expect_over<Yielded>(stream, [](const Yielded& error) {
    EXPECT_STREQ(
        error.what(),
        "elbow: did not follow the stream to its end: it yielded to a load of 13.1 N.m (load_Nm allows "
        "12) at 0.3011 rad; it holds at 0.1 rad");
    EXPECT_EQ(error.to().load_Nm, -13.1042);
    EXPECT_EQ(error.to().position_rad, 0.3011);
  });
}

TEST_F(StreamTest, IsNotBegunAnewByASampleAfterItsEnd) {
  daemon.daemon().after_answer = [this] { daemon.daemon().reason = Reason::kStreamEnded; };
  auto ended = joint.stream({.ahead_s = 0.9});
  ended.put(0.0, 0.1);
  double t_s = 0.0;
  EXPECT_THROW(while (t_s < 10.0) ended.put(t_s += 0.01, 0.1), Refused);
  daemon.daemon().after_answer = nullptr;
  daemon.daemon().reason = Reason::kAccepted;
  EXPECT_THROW(ended.put(t_s + 0.5, 0.1), NotDone) << "somebody else has ended it";
  auto closed = joint.stream({.ahead_s = 0.9});
  closed.put(0.0, 0.2);
  closed.close();
  EXPECT_THROW(closed.put(0.5, 0.2), NotDone);
  int begun = 0;
  for (const setpoint_v1& setpoint : heard<setpoint_v1>()) begun += setpoint.begins_stream;
  EXPECT_EQ(begun, 2);
}

}  // namespace
}  // namespace strainwave
