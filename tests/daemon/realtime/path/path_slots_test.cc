// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/path/path_slots.h"

#include <gtest/gtest.h>

#include <thread>

namespace strainwave {
namespace {

LoadedPath path_with(std::int64_t id) {
  LoadedPath loaded{id, 1, {}};
  loaded.path.count = KnotPath::kMostKnots;
  for (PathKnot& knot : loaded.path.knots) knot = {static_cast<double>(id), static_cast<double>(id), 0.0};
  return loaded;
}

TEST(PathSlots, BringOnePathAtATime) {
  PathSlots slots;
  const auto first = slots.hand_over(path_with(1));
  ASSERT_TRUE(first);
  EXPECT_FALSE(slots.hand_over(path_with(2))) << "the loop has not looked at the first";
  slots.judged();
  EXPECT_TRUE(slots.hand_over(path_with(3))) << "the loop did not want the first";
  slots.take_back();
  EXPECT_TRUE(slots.hand_over(path_with(4)));
}

// One thread hands over paths and another uses them. No path is ever half-written, even while the previous one is in use.
TEST(PathSlots, ShowWholePathsToTheOtherThread) {
  PathSlots slots;
  std::atomic<std::int32_t> ordered{-1};
  constexpr std::int64_t kPaths = 500;
  std::thread supervisor([&] {
    for (std::int64_t id = 1; id <= kPaths;) {
      const auto slot = slots.hand_over(path_with(id));
      if (!slot) {
        std::this_thread::yield();
        continue;
      }
      ordered.store(*slot);
      ++id;
      while (ordered.load() >= 0) std::this_thread::yield();
    }
  });
  const auto whole = [](const LoadedPath& path) {
    for (const PathKnot& knot : path.path.knots)
      if (knot.time_s != static_cast<double>(path.id)) return false;
    return true;
  };
  std::int64_t seen = 0;
  std::int32_t used = -1;
  while (seen < kPaths) {
    const std::int32_t slot = ordered.load();
    if (used >= 0) {
      ASSERT_TRUE(whole(slots.at(used)));
    }
    if (slot < 0) continue;
    ASSERT_TRUE(whole(slots.at(slot)));
    if (seen % 3 != 0) slots.use(used = slot);
    if (seen % 7 == 0) {
      slots.drop();
      used = -1;
    }
    ++seen;
    slots.judged();
    ordered.store(-1);
  }
  supervisor.join();
}

}  // namespace
}  // namespace strainwave
