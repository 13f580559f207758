// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/send_queue.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

std::shared_ptr<const std::string> text(std::size_t size, char letter = 'x') {
  return std::make_shared<const std::string>(size, letter);
}

TEST(SendQueue, KeepsTheNewestDataOfAViewerThatIsTooSlow) {
  SendQueue queue;
  constexpr std::uint32_t kMessages = 10000;
  for (std::uint32_t i = 0; i < kMessages; ++i) {
    queue.push_data(message_head(i, 0), text(1000));
    ASSERT_LE(queue.waiting_bytes(), SendQueue::kMaxDataBytes);
  }
  std::uint32_t left = 0;
  std::optional<OutgoingFrame> last;
  while (auto frame = queue.pop()) {
    last = std::move(frame);
    ++left;
  }
  EXPECT_GT(left, 1000U);
  EXPECT_EQ(queue.dropped() + left, kMessages);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->head, message_head(kMessages - 1, 0));
  EXPECT_EQ(queue.waiting_bytes(), 0U);
}

TEST(SendQueue, SendsWhatAViewerMustKnowFirstAndNeverDropsIt) {
  SendQueue queue;
  queue.push_data(message_head(1, 0), text(10));
  ASSERT_TRUE(queue.push_control("topic"));
  for (int i = 0; i < 10; ++i) queue.push_data(message_head(2, 0), text(SendQueue::kMaxDataBytes / 2));
  const auto first = queue.pop();
  ASSERT_TRUE(first);
  EXPECT_EQ(*first->body, "topic");
  EXPECT_FALSE(first->head);
}

TEST(SendQueue, GivesUpAViewerThatLetsWhatItMustKnowPileUp) {
  SendQueue queue;
  int pushed = 0;
  while (queue.push_control(std::string(1000, 'x'))) ASSERT_LT(++pushed, 10000);
  EXPECT_GT(pushed, 1000);
}

TEST(SendQueue, HoldsNoMoreThanItsBoundOfOneHugeMessage) {
  SendQueue queue;
  queue.push_data(message_head(1, 0), text(SendQueue::kMaxDataBytes + 1));
  EXPECT_EQ(queue.waiting_bytes(), 0U);
  EXPECT_EQ(queue.dropped(), 1U);
}

}  // namespace
}  // namespace strainwave
