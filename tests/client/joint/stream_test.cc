// SPDX-License-Identifier: BSD-3-Clause
// The samples that a stream sends, and those that it refuses.
#include "strainwave/stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <strainwave/setpoint_v1.hpp>

#include "tests/client/joint/stream_fixture.h"
#include "tests/support/refusal.h"

namespace strainwave {
namespace {

using testing::StreamTest;

TEST_F(StreamTest, SendsEachSampleForTheCycleThatItsTimeIs) {
  auto stream = joint.stream({.ahead_s = 0.9, .valid_for_s = 5.0, .speed_limit_rad_s = 0.5});
  std::vector<double> sent;
  for (int i = 0; i < 40; ++i)
    if (stream.put(100.0 + 0.01 * i, 0.02 * i, 2.0, {}, {.torque_Nm = -0.5, .load_inertia_kgm2 = 0.01}))
      sent.push_back(0.02 * i);
  const std::int64_t begin = stream.cycle_of(100.0);
  const std::int64_t middle = stream.cycle_of(100.2);
  stream.close();
  const auto setpoints = heard<setpoint_v1>();
  ASSERT_EQ(setpoints.size(), sent.size());
  const setpoint_v1& first = setpoints.front();
  EXPECT_EQ(first.begins_stream, 1);
  EXPECT_NE(first.stream_id, 0);
  EXPECT_EQ(begin, first.at_cycle);
  EXPECT_EQ(middle, first.at_cycle + 200);
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

TEST_F(StreamTest, TellsNoCycleBeforeItHasBegunAndNoneOfWhatIsNoTime) {
  auto stream = joint.stream();
  EXPECT_THROW((void)stream.cycle_of(0.0), NotDone);
  stream.put(0.0, 0.1);
  for (const double t_s : {std::nan(""), HUGE_VAL, 1e300})
    EXPECT_THROW((void)stream.cycle_of(t_s), InvalidInput);
  EXPECT_EQ(stream.cycle_of(-1e12), stream.cycle_of(0.0) - 1'000'000'000'000'000);
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
  for (const setpoint_v1& setpoint : heard<setpoint_v1>())
    cycles[setpoint.position_rad].push_back(setpoint.at_cycle);
  EXPECT_EQ(cycles.at(0.1), cycles.at(0.2));
}

TEST_F(StreamTest, IsBesideNoneOfAnotherDaemonWhichCountsItsOwnCycles) {
  Joint others{"wrist", {.key = "", .prefix = "B", .lcm_url = own_url()}};
  auto first = joint.stream();
  const std::string refused =
      testing::refusal_of<InvalidInput>([&] { auto second = others.stream({.beside = &first}); });
  EXPECT_EQ(refused, "wrist has prefix B, elbow has SW: streams beside each other must belong to one daemon");
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
  for (const setpoint_v1& setpoint : heard<setpoint_v1>()) EXPECT_EQ(setpoint.position_rad, 0.1);
}

TEST_F(StreamTest, InMillisecondsIsRefusedBeforeItWaitsForSeconds) {
  for (const double step : {1.0, 10.0}) {  // 1 kHz and 100 Hz, in milliseconds
    auto stream = joint.stream({.ahead_s = 0.1});
    stream.put(0.0, 0.1);
    try {
      stream.put(step, 0.1);
      ADD_FAILURE() << "was waited for";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("t_s counts seconds, not milliseconds"), std::string::npos)
          << error.what();
    }
  }
}

TEST_F(StreamTest, RefusesWhatIsNoSampleAndSendsNothing) {
  auto stream = joint.stream();
  const std::string refused = testing::refusal_of<InvalidInput>([&] { stream.put(0.0, 3.5); });
  EXPECT_EQ(refused,
            "elbow: position_rad = 3.5: from -3 to 3 is allowed (joint.limits.position_min_rad and "
            "position_max_rad of elbow)");
  const std::string degrees =
      testing::refusal_of<InvalidInput>([&] { stream.put(0.0, 90.0, 0.0, {}, {.torque_Nm = -30.5}); });
  EXPECT_TRUE(degrees.ends_with("; positions are in rad: 90 degrees would be 1.5708")) << degrees;
  EXPECT_THROW(stream.put(0.0, 0.1, std::nan("")), InvalidInput);
  EXPECT_THROW(stream.put(0.0, 0.1, {}, 1.0), InvalidInput);
  EXPECT_THROW(stream.put(std::nan(""), 0.1), InvalidInput);
  EXPECT_THROW(stream.put(0.0, 0.1, 0.0, {}, {.torque_Nm = std::nan("")}), InvalidInput);
  const std::string torque =
      testing::refusal_of<InvalidInput>([&] { stream.put(0.0, 0.1, 0.0, {}, {.torque_Nm = -30.5}); });
  EXPECT_EQ(torque,
            "elbow: torque_Nm = -30.5: from -30 to 30 is allowed (joint.limits.torque_limit_Nm of elbow)");
  EXPECT_THROW(stream.put(0.0, 0.1, 0.0, {}, {.load_inertia_kgm2 = -0.1}), InvalidInput);
  stream.close();
  EXPECT_TRUE(heard<setpoint_v1>().empty());
}

}  // namespace
}  // namespace strainwave
