#include "daemon/admission/sequence_memory.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

namespace strainwave {
namespace {

using Judgement = SequenceMemory::Judgement;

TEST(SequenceMemory, TellsRisingRepeatedAndOldApartForEachSender) {
  SequenceMemory memory;
  EXPECT_EQ(memory.judge(1, 10), Judgement::kNew);
  EXPECT_EQ(memory.judge(2, 5), Judgement::kNew);
  EXPECT_EQ(memory.judge(1, 10), Judgement::kRepeat);
  EXPECT_EQ(memory.judge(1, 9), Judgement::kOld);
  EXPECT_EQ(memory.judge(1, 100), Judgement::kNew);
  EXPECT_EQ(memory.judge(2, 6), Judgement::kNew);
  EXPECT_EQ(memory.judge(2, 5), Judgement::kOld);
}

TEST(SequenceMemory, NeverTakesAMessageTwiceHoweverManySendersComeAndGo) {
  SequenceMemory memory;
  std::mt19937_64 random(1);
  std::set<std::pair<std::int64_t, std::int64_t>> taken;
  std::int64_t clock = 0;
  for (int i = 0; i < 200'000; ++i) {
    // Half new messages with a rising clock, half replays of what was sent before or numbers near it.
    const auto sender = static_cast<std::int64_t>(random() % 500);
    const std::int64_t sequence =
        random() % 2 == 0 ? ++clock : static_cast<std::int64_t>(random()) % (clock + 1);
    if (memory.judge(sender, sequence) == Judgement::kNew) {
      EXPECT_TRUE(taken.emplace(sender, sequence).second) << sender << " " << sequence;
    }
    ASSERT_LE(memory.size(), SequenceMemory::kSenders);
  }
  EXPECT_GT(taken.size(), 50'000U);
}

TEST(SequenceMemory, BelievesANewSenderWhoseClockIsRightHoweverManyWereForgotten) {
  SequenceMemory memory;
  std::int64_t clock = 1'700'000'000'000'000;
  for (std::int64_t sender = 0; sender < 10'000; ++sender)
    EXPECT_EQ(memory.judge(sender, ++clock), Judgement::kNew);
  EXPECT_EQ(memory.judge(3, clock + 1), Judgement::kNew);  // forgotten, and back
  EXPECT_EQ(memory.judge(10'001, 1), Judgement::kOld);
}

TEST(SequenceMemory, WithoutAFloorOneSenderCannotLockOutTheOthers) {
  SequenceMemory memory(false);
  for (std::int64_t sender = 0; sender < 200; ++sender) memory.judge(sender, INT64_MAX - sender);
  EXPECT_EQ(memory.judge(1000, 1), Judgement::kNew);
}

}  // namespace
}  // namespace strainwave
