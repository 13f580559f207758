// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/sequence_memory.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

namespace strainwave {
namespace {

using Judgement = SequenceMemory::Judgement;
constexpr std::int64_t kLifetime = 1000;
constexpr std::size_t kBound = 64;

TEST(SequenceMemory, TellsRisingRepeatedAndOldApart) {
  SequenceMemory memory(kLifetime, kBound);
  EXPECT_EQ(memory.judge({0, 0}, 1, 10, 0), Judgement::kNew);
  EXPECT_EQ(memory.judge({0, 0}, 1, 10, 1), Judgement::kRepeat);
  EXPECT_EQ(memory.judge({0, 0}, 1, 9, 2), Judgement::kOld);
  EXPECT_EQ(memory.judge({0, 0}, 1, 100, 3), Judgement::kNew);
  EXPECT_EQ(memory.last({0, 0}), 100);
  EXPECT_TRUE(memory.is_last({0, 0}, 1, 100));
  EXPECT_EQ(memory.judge({0, 0}, 1, 100, 10 * kLifetime), Judgement::kRepeat) << "however late it comes";
}

TEST(SequenceMemory, WantsTheSequenceToRiseOverAllSendersOfAKeyAndOverNoOtherKeyOrJoint) {
  SequenceMemory memory(kLifetime, kBound);
  ASSERT_EQ(memory.judge({0, 0}, 1, 10, 0), Judgement::kNew);
  EXPECT_EQ(memory.judge({0, 0}, 2, 10, 1), Judgement::kOld) << "another sender of the key: no repetition";
  EXPECT_EQ(memory.judge({0, 0}, 2, 9, 1), Judgement::kOld);
  EXPECT_EQ(memory.judge({1, 0}, 1, 9, 1), Judgement::kNew);
  EXPECT_EQ(memory.judge({0, 1}, 1, 9, 1), Judgement::kNew);
}

TEST(SequenceMemory, BelievesAnySequenceWhenTheLastOneIsOlderThanAnOrderMayBecome) {
  SequenceMemory memory(kLifetime, kBound);
  ASSERT_EQ(memory.judge({0, 0}, 1, INT64_MAX, 0), Judgement::kNew);
  EXPECT_EQ(memory.judge({0, 0}, 1, 5, kLifetime), Judgement::kOld);
  EXPECT_EQ(memory.judge({0, 0}, 1, 5, kLifetime + 1), Judgement::kNew);
}

TEST(SequenceMemory, NeverTakesAMessageTwiceWithinItsLifetimeAndStaysBounded) {
  SequenceMemory memory(kLifetime, kBound);
  std::mt19937_64 random(1);
  std::set<std::tuple<std::int64_t, std::size_t, std::int64_t>> taken;
  for (std::int64_t cycle = 0; cycle < kLifetime; ++cycle) {
    for (int i = 0; i < 100; ++i) {
      const SequenceMemory::Identity identity{static_cast<std::int64_t>(random() % 8), random() % 8};
      const std::int64_t sequence = static_cast<std::int64_t>(random() % 10'000);
      if (memory.judge(identity, 1, sequence, cycle) == Judgement::kNew) {
        EXPECT_TRUE(taken.emplace(identity.who, identity.joint, sequence).second);
      }
    }
  }
  for (std::int64_t who = 0; who < 1000; ++who) memory.judge({who, 0}, 1, 1, kLifetime);
  EXPECT_LE(memory.size(), kBound);
  EXPECT_GT(taken.size(), 64U);
}

}  // namespace
}  // namespace strainwave
