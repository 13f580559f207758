// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/order_queue.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/support/lcm_datagrams.h"

namespace strainwave {
namespace {

constexpr LcmSource kQuiet{0xc0a80705, 1};
constexpr LcmSource kLoud{0xc0a80706, 2};

class Queue {
 public:
  explicit Queue(std::size_t capacity) : queue_(capacity) {}
  void push(const LcmSource& from, const std::string& channel) {
    queue_.push(from, channel, testing::pattern(7));
  }
  /// Channel of the next message, or "none".
  std::string pop() { return queue_.pop(*message_) ? std::string(message_->channel.view()) : "none"; }
  const OrderQueue& queue() const { return queue_; }
  const WireMessage& last() const { return *message_; }

 private:
  OrderQueue queue_;
  std::unique_ptr<WireMessage> message_ = std::make_unique<WireMessage>();
};

TEST(OrderQueue, KeepsTheOrderOfEachSource) {
  Queue queue(8);
  for (const char* channel : {"1", "2", "3"}) queue.push(kQuiet, channel);
  for (const char* channel : {"1", "2", "3", "none"}) EXPECT_EQ(queue.pop(), channel);
}

TEST(OrderQueue, HandsOverTheBytesAsTheyCame) {
  Queue queue(2);
  queue.push(kQuiet, "SW.elbow.COMMAND");
  queue.pop();
  ASSERT_EQ(queue.last().size, 7U);
  EXPECT_EQ(testing::Bytes(queue.last().bytes.begin(), queue.last().bytes.begin() + 7), testing::pattern(7));
}

TEST(OrderQueue, DelaysAMessageByNoMoreThanOneOfEachOtherSource) {
  Queue queue(256);
  for (int i = 0; i < 200; ++i) queue.push(kLoud, "loud");
  for (int i = 0; i < 50; ++i) EXPECT_EQ(queue.pop(), "loud");
  queue.push(kQuiet, "quiet");
  EXPECT_EQ(queue.pop(), "loud");
  EXPECT_EQ(queue.pop(), "quiet");
}

TEST(OrderQueue, LetsSourcesTakeTurnsAlsoOverTime) {
  Queue queue(64);
  int quiet = 0;
  for (int round = 0; round < 1000; ++round) {
    for (int i = 0; i < 3; ++i) queue.push(kLoud, "loud");
    queue.push(kQuiet, "quiet");
    for (int i = 0; i < 2; ++i) quiet += queue.pop() == "quiet" ? 1 : 0;
  }
  EXPECT_EQ(quiet, 1000);
}

TEST(OrderQueue, TakesTheRoomFromWhoHasMostWhenItIsFull) {
  Queue queue(16);
  for (int i = 0; i < 100; ++i) queue.push(kLoud, std::to_string(i));
  EXPECT_EQ(queue.queue().crowded_out(), 84U);
  queue.push(kQuiet, "quiet");
  EXPECT_EQ(queue.queue().crowded_out(), 85U);
  EXPECT_EQ(queue.pop(), "0");
  EXPECT_EQ(queue.pop(), "quiet");
  // The loud source lost its newest messages.
  for (int i = 1; i < 15; ++i) EXPECT_EQ(queue.pop(), std::to_string(i));
  EXPECT_EQ(queue.pop(), "none");
}

TEST(OrderQueue, TakesNothingLongerThanAMessage) {
  OrderQueue queue(2);
  queue.push(kQuiet, "c", testing::pattern(WireMessage::kMaxBytes + 1));
  const auto message = std::make_unique<WireMessage>();
  EXPECT_FALSE(queue.pop(*message));
}

}  // namespace
}  // namespace strainwave
