// What a stream sends, and what becomes of answers to it.
#include "client/joint/stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v2.hpp>

#include "client/joint/joint.h"
#include "lcmtypes/wire.h"
#include "tests/client/link/running_daemon.h"

namespace strainwave {
namespace {

class StreamTest : public ::testing::Test {
 protected:
  /// What was heard, without repetitions, once the daemon is silent.
  template <typename Message>
  std::vector<Message> heard() {
    daemon.stop();
    std::vector<Message> messages;
    for (const FakeDaemon::Heard& order : daemon.daemon().heard()) {
      const auto message = decode_exactly<Message>(order.bytes);
      if (message && (messages.empty() || messages.back().sequence != message->sequence))
        messages.push_back(*message);
    }
    return messages;
  }

  RunningDaemon daemon{own_url()};
  Joint joint{"elbow", {.key = "", .lcm_url = own_url(), .timeout_s = 20.0}};
};

TEST_F(StreamTest, SendsEachSampleForTheCycleThatItsTimeIs) {
  auto stream = joint.stream({.ahead_s = 0.9, .valid_for_s = 5.0, .speed_limit_rad_s = 0.5});
  std::vector<double> sent;
  for (int i = 0; i < 40; ++i)
    if (stream.put(100.0 + 0.01 * i, 0.02 * i, 2.0, {}, {.torque_Nm = -0.5, .load_inertia_kgm2 = 0.01}))
      sent.push_back(0.02 * i);
  stream.close();
  const auto setpoints = heard<setpoint_v2>();
  ASSERT_EQ(setpoints.size(), sent.size());
  const setpoint_v2& first = setpoints.front();
  EXPECT_EQ(first.begins_stream, 1);
  EXPECT_NE(first.stream_id, 0);
  for (std::size_t i = 0; i < setpoints.size(); ++i) {
    EXPECT_EQ(setpoints[i].position_rad, sent[i]);
    EXPECT_EQ(setpoints[i].at_cycle - first.at_cycle, std::llround(500.0 * sent[i]));
    EXPECT_EQ(setpoints[i].begins_stream, i == 0 ? 1 : 0);
    EXPECT_EQ(setpoints[i].stream_id, first.stream_id);
    EXPECT_EQ(setpoints[i].velocity_rad_s, 2.0);
    EXPECT_EQ(setpoints[i].derivatives, 1);
    EXPECT_EQ(setpoints[i].torque_Nm, -0.5);
    EXPECT_EQ(setpoints[i].load_inertia_kgm2, 0.01);
    EXPECT_EQ(setpoints[i].valid_for_s, 5.0);
    EXPECT_EQ(setpoints[i].speed_limit_rad_s, 0.5);
  }
}

TEST_F(StreamTest, EndsInAHoldOnceItsLastSamplesTimeHasCome) {
  {
    auto stream = joint.stream();
    stream.put(0.0, 0.1);
    stream.put(0.2, 0.1);
  }
  const std::int64_t end = daemon.cycle();
  const auto setpoints = heard<setpoint_v2>();
  const auto commands = heard<command_v1>();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].action, static_cast<std::int32_t>(Action::kHold));
  EXPECT_GE(end, setpoints.back().at_cycle);
}

TEST_F(StreamTest, HoldsAtOnceAfterAnException) {
  struct Trouble {};
  try {
    auto stream = joint.stream({.ahead_s = 0.9});
    stream.put(0.0, 0.1);
    stream.put(0.5, 0.1);
    throw Trouble{};
  } catch (const Trouble&) {
  }
  const auto setpoints = heard<setpoint_v2>();
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

TEST_F(StreamTest, BesideAnotherHasTheSameCycleForTheSameTime) {
  Joint same{"elbow", {.key = "", .lcm_url = own_url(), .timeout_s = 20.0}};
  auto first = joint.stream({.ahead_s = 0.9});
  auto second = same.stream({.ahead_s = 0.9, .beside = &first});
  first.put(5.0, 0.1);
  second.put(5.0, 0.2);
  first.put(5.1, 0.1);
  second.put(5.1, 0.2);
  first.close();
  second.close();
  std::map<double, std::vector<std::int64_t>> cycles;
  for (const setpoint_v2& setpoint : heard<setpoint_v2>())
    cycles[setpoint.position_rad].push_back(setpoint.at_cycle);
  EXPECT_EQ(cycles.at(0.1), cycles.at(0.2));
}

TEST_F(StreamTest, IsBesideNoneOfAnotherDaemonWhichCountsItsOwnCycles) {
  Joint others{"wrist", {.key = "", .prefix = "B", .lcm_url = own_url()}};
  auto first = joint.stream();
  try {
    auto second = others.stream({.beside = &first});
    FAIL() << "was not refused";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()),
              "wrist has prefix B, elbow has SW: streams beside each other are of one daemon");
  }
  const auto moved = std::move(first);
  EXPECT_THROW((void)joint.stream({.beside = &first}),
               InvalidInput);  // NOLINT(bugprone-use-after-move): that is tried
}

TEST_F(StreamTest, LeavesOutWhatComesAfterItsTime) {
  auto stream = joint.stream({.ahead_s = 0.05});
  EXPECT_TRUE(stream.put(0.0, 0.1));
  const std::int64_t first = joint.state().cycle;
  while (joint.state().cycle < first + 300) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(stream.put(0.1, 0.2));
  EXPECT_EQ(stream.late(), 1);
  stream.close();
  for (const setpoint_v2& setpoint : heard<setpoint_v2>()) EXPECT_EQ(setpoint.position_rad, 0.1);
}

// A played daemon for each reason: samples of the first stream are still on their way when it has ended.
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
  }
  EXPECT_THROW(stream.put(20.0, 0.1), NotDone) << "over";
}
INSTANTIATE_TEST_SUITE_P(ForEachReason, EndedStreamTest,
                         ::testing::Values(Reason::kStreamEnded, Reason::kSuperseded));

// A played daemon that stays silent about its joint, and refuses what comes, until the joint has come to its end.
class StoppedStreamTest : public StreamTest {
 protected:
  Stream begun() {
    auto stream = joint.stream({.ahead_s = 0.9, .valid_for_s = 10.0});
    stream.put(0.0, 0.1);
    return stream;
  }
  /// What the put that finds it out throws.
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
  for (const setpoint_v2& setpoint : heard<setpoint_v2>()) begun += setpoint.begins_stream;
  EXPECT_EQ(begun, 2);
}

TEST_F(StreamTest, RefusesWhatIsNoSampleAndSendsNothing) {
  auto stream = joint.stream();
  try {
    stream.put(0.0, 3.5);
    ADD_FAILURE() << "a position beyond the range was sent";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "elbow: position_rad = 3.5: from -3 to 3 is allowed (joint.limits.position_min_rad and "
                 "position_max_rad of elbow)");
  }
  try {
    stream.put(0.0, 90.0, 0.0, {}, {.torque_Nm = -30.5});
    ADD_FAILURE() << "degrees were sent";
  } catch (const InvalidInput& error) {
    EXPECT_TRUE(std::string(error.what()).ends_with("; positions are in rad: 90 degrees would be 1.5708"))
        << error.what();
  }
  EXPECT_THROW(stream.put(0.0, 0.1, std::nan("")), InvalidInput);
  EXPECT_THROW(stream.put(0.0, 0.1, {}, 1.0), InvalidInput);
  EXPECT_THROW(stream.put(std::nan(""), 0.1), InvalidInput);
  EXPECT_THROW(stream.put(0.0, 0.1, 0.0, {}, {.torque_Nm = std::nan("")}), InvalidInput);
  try {
    stream.put(0.0, 0.1, 0.0, {}, {.torque_Nm = -30.5});
    ADD_FAILURE() << "a torque beyond the limit was sent";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(
        error.what(),
        "elbow: torque_Nm = -30.5: from -30 to 30 is allowed (joint.limits.torque_limit_Nm of elbow)");
  }
  EXPECT_THROW(stream.put(0.0, 0.1, 0.0, {}, {.load_inertia_kgm2 = -0.1}), InvalidInput);
  stream.close();
  EXPECT_TRUE(heard<setpoint_v2>().empty());
}

}  // namespace
}  // namespace strainwave
