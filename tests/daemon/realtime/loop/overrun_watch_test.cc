// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/overrun_watch.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;

TEST(OverrunWatch, SpeaksAtOnceOfAStallThatIsTooLong) {
  OverrunWatch watch({0.02, 1.0}, kPeriod_s);
  EXPECT_EQ(watch.judge(19), Fault::kNone) << "20 ms from one cycle to the next";
  EXPECT_EQ(watch.judge(20), Fault::kLoopStalled);
  EXPECT_EQ(watch.judge(1'000'000'000), Fault::kLoopStalled);
  EXPECT_EQ(watch.judge(0), Fault::kNone);
}

TEST(OverrunWatch, SpeaksWhenALargerShareOfASecondIsMissedThanAllowedHoweverItIsSpread) {
  for (const std::int64_t skipped : {1, 3, 15}) {
    // A cycle misses `skipped` periods. The number of timely periods after it makes the share slightly too small or too large.
    for (const double share : {0.08, 0.12}) {
      OverrunWatch watch({0.02, 0.1}, kPeriod_s);
      const auto in_time = static_cast<std::int64_t>(static_cast<double>(skipped) * (1.0 / share - 1.0));
      bool spoken = false;
      for (std::int64_t periods = 0; periods < 5000 && !spoken; periods += skipped + in_time) {
        spoken = watch.judge(skipped) == Fault::kPeriodsMissed;
        for (std::int64_t i = 1; i < in_time; ++i) EXPECT_EQ(watch.judge(0), Fault::kNone);
      }
      EXPECT_EQ(spoken, share > 0.1) << skipped << " missed at a time";
    }
  }
}

TEST(OverrunWatch, SpeaksWithinAQuarterOfASecondOfALoopThatIsLateInEveryCycle) {
  OverrunWatch watch({0.02, 0.1}, kPeriod_s);
  int cycles = 1;
  for (; watch.judge(1) == Fault::kNone && cycles < 1000; ++cycles) {
  }
  EXPECT_LE(2 * cycles, 250);
  EXPECT_EQ(watch.judge(1), Fault::kNone) << "it begins anew";
}

TEST(OverrunWatch, ForgetsWhatIsSecondsAgo) {
  OverrunWatch watch({0.02, 0.1}, kPeriod_s);
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 9; ++i) EXPECT_EQ(watch.judge(10), Fault::kNone) << "90 of a thousand";
    for (int i = 0; i < 3000; ++i) EXPECT_EQ(watch.judge(0), Fault::kNone);
  }
}

}  // namespace
}  // namespace strainwave
