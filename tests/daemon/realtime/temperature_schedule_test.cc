// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/temperature_schedule.h"

#include <gtest/gtest.h>

#include <vector>

namespace strainwave {
namespace {

TEST(TemperatureSchedule, KeepsItsTemperatureBetweenItsTurns) {
  TemperatureSchedule schedule(0.01, 0.001, 0);
  double shown_C = schedule.follow_C(0.0, 0, false);
  int changes = 0;
  for (std::int64_t cycle = 1; cycle <= 1000; ++cycle) {
    const double now_C = schedule.follow_C(static_cast<double>(cycle), cycle, false);
    changes += now_C != shown_C ? 1 : 0;
    shown_C = now_C;
    EXPECT_LT(static_cast<double>(cycle) - shown_C, 10.0);
  }
  EXPECT_EQ(changes, 100);
}

TEST(TemperatureSchedule, LetsJointsTakeTurns) {
  std::vector<TemperatureSchedule> schedules;
  for (std::int64_t turn = 0; turn < 10; ++turn) schedules.emplace_back(0.01, 0.001, turn);
  std::vector<double> shown_C(10, 0.0);
  for (std::int64_t cycle = 1; cycle <= 200; ++cycle) {
    int changes = 0;
    for (std::size_t i = 0; i < schedules.size(); ++i) {
      const double now_C = schedules[i].follow_C(static_cast<double>(cycle), cycle, false);
      changes += now_C != shown_C[i] ? 1 : 0;
      shown_C[i] = now_C;
    }
    if (cycle > 10) {
      EXPECT_EQ(changes, 1) << cycle;
    }
  }
}

TEST(TemperatureSchedule, IsNotStoppedByCyclesThatWereLeftOut) {
  TemperatureSchedule schedule(0.01, 0.001, 3);
  for (std::int64_t cycle = 0; cycle < 1000; cycle += 7) {
    const double shown_C = schedule.follow_C(static_cast<double>(cycle), cycle, false);
    EXPECT_LT(static_cast<double>(cycle) - shown_C, 17.0);
  }
}

TEST(TemperatureSchedule, TakesTheTemperatureAtOnceWhenAsked) {
  TemperatureSchedule schedule(0.01, 0.001, 0);
  (void)schedule.follow_C(20.0, 0, true);
  EXPECT_EQ(schedule.follow_C(25.0, 1, false), 20.0);
  EXPECT_EQ(schedule.follow_C(25.0, 2, true), 25.0);
}

TEST(TemperatureSchedule, FollowsEveryCycleWhenItsPeriodIsShorterThanOne) {
  TemperatureSchedule schedule(1e-4, 0.001, 5);
  for (std::int64_t cycle = 0; cycle < 20; ++cycle)
    EXPECT_EQ(schedule.follow_C(static_cast<double>(cycle), cycle, false), static_cast<double>(cycle));
}

}  // namespace
}  // namespace strainwave
