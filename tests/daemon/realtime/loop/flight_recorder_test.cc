// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/flight_recorder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace strainwave {
namespace {

FlightSample sample(std::int64_t cycle, std::uint8_t fault = 0) {
  FlightSample sample;
  sample.cycle = cycle;
  sample.time_ns = cycle * 1'000'000;
  sample.joint_position_rad = static_cast<double>(cycle);
  sample.fault = fault;
  return sample;
}

TEST(FlightRecorder, KeepsTheLastSamplesAndSomeAfterTheFault) {
  FlightRecorder recorder(10, 3);
  std::int64_t cycle = 0;
  while (cycle < 57) recorder.write(sample(++cycle));
  EXPECT_FALSE(recorder.frozen());
  while (!recorder.frozen()) recorder.write(sample(++cycle, 13));
  EXPECT_EQ(cycle, 57 + 1 + 3);
  ASSERT_EQ(recorder.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(recorder.sample(i).cycle, cycle - 9 + static_cast<std::int64_t>(i));
  EXPECT_EQ(recorder.fault_index(), 6U);
  EXPECT_EQ(recorder.sample(recorder.fault_index()).cycle, 58);
}

TEST(FlightRecorder, FreezesOnceForOneLatchedFault) {
  FlightRecorder recorder(10, 0);
  recorder.write(sample(1, 4));
  ASSERT_TRUE(recorder.frozen());
  recorder.release();
  for (std::int64_t cycle = 2; cycle < 50; ++cycle) recorder.write(sample(cycle, 4));
  EXPECT_FALSE(recorder.frozen());
  recorder.write(sample(50, 0));
  recorder.write(sample(51, 5));
  EXPECT_TRUE(recorder.frozen()) << "the next fault is another record";
}

TEST(FlightRecorder, CountsWhatItLosesWhileFrozenAndChangesNothing) {
  FlightRecorder recorder(4, 0);
  recorder.write(sample(1, 4));
  for (std::int64_t cycle = 2; cycle < 9; ++cycle) recorder.write(sample(cycle, 0));
  EXPECT_EQ(recorder.size(), 1U);
  EXPECT_EQ(recorder.sample(0).cycle, 1);
  recorder.release();
  recorder.write(sample(9, 0));
  recorder.write(sample(10, 6));
  ASSERT_TRUE(recorder.frozen());
  EXPECT_EQ(recorder.lost(), 7);
  EXPECT_EQ(recorder.size(), 2U);
  EXPECT_EQ(recorder.fault_index(), 1U) << "there are no more before it";
}

TEST(FlightRecorder, GivesAnotherThreadWholeRecordsOnly) {
  FlightRecorder recorder(64, 16);
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (std::int64_t cycle = 1; !stop; ++cycle) recorder.write(sample(cycle, cycle % 100 > 90 ? 5 : 0));
  });
  for (int record = 0; record < 200; ++record) {
    while (!recorder.frozen()) std::this_thread::yield();
    ASSERT_EQ(recorder.sample(recorder.fault_index()).cycle % 100, 91);
    for (std::size_t i = 1; i < recorder.size(); ++i)
      ASSERT_EQ(recorder.sample(i).cycle, recorder.sample(i - 1).cycle + 1);
    for (std::size_t i = 0; i < recorder.size(); ++i)
      ASSERT_EQ(recorder.sample(i).joint_position_rad, static_cast<double>(recorder.sample(i).cycle));
    recorder.release();
  }
  stop = true;
  writer.join();
}

}  // namespace
}  // namespace strainwave
