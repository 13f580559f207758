// SPDX-License-Identifier: BSD-3-Clause
// Values from an ordinary thread for the loop. Also run under the thread sanitizer.
#include "base/latest_value.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace strainwave {
namespace {

struct Value {
  std::uint64_t a = 0;
  double b = 0.0;
  std::int32_t c = 0;
};

TEST(LatestValue, HasNothingToGiveBeforeTheFirstPut) {
  const LatestValue<Value> latest;
  Value value{1, 2.0, 3};
  EXPECT_FALSE(latest.take(value));
  EXPECT_EQ(value.a, 1U) << "what the reader had stays";
}

TEST(LatestValue, GivesTheNewestValueAgainAndAgain) {
  LatestValue<Value> latest;
  latest.put({1, 1.0, 1});
  latest.put({2, 2.0, 2});
  for (int i = 0; i < 2; ++i) {
    Value value;
    ASSERT_TRUE(latest.take(value));
    EXPECT_EQ(value.a, 2U);
    EXPECT_EQ(value.b, 2.0);
    EXPECT_EQ(value.c, 2);
  }
}

TEST(LatestValue, IsNeverTornAndNeverGoesBack) {
  constexpr std::uint64_t kValues = 200'000;
  LatestValue<Value> latest;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kValues; ++i)
      latest.put({i, static_cast<double>(i), static_cast<std::int32_t>(i)});
    done.store(true);
  });
  std::uint64_t previous = 0;
  for (bool last = false; !last;) {
    last = done.load();
    Value value;
    if (!latest.take(value)) continue;
    ASSERT_EQ(static_cast<double>(value.a), value.b);
    ASSERT_EQ(static_cast<std::int32_t>(value.a), value.c);
    ASSERT_GE(value.a, previous);
    previous = value.a;
  }
  writer.join();
  EXPECT_EQ(previous, kValues);
}

}  // namespace
}  // namespace strainwave
