// Orders on their way through the loop, without its thread: what it takes and what it replies is the test's.
#include "daemon/admission/pending_orders.h"

#include <gtest/gtest.h>

#include <memory>
#include <strainwave/ack_v1.hpp>

#include "lcmtypes/wire.h"
#include "tests/support/joint_bench.h"

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

LoopParts one_joint() {
  LoopParts parts;
  const testing::BenchJoint joint = testing::demo_joint();
  parts.joints.push_back({joint.loop, std::make_unique<SimulatedActuator>(joint.drive), nullptr});
  return parts;
}

class PendingOrdersTest : public ::testing::Test {
 protected:
  Verdict order(OrderKind kind, bool authentic = false) {
    Verdict verdict;
    verdict.kind = Verdict::Kind::kOrder;
    verdict.order.kind = kind;
    verdict.requester.sender_id = 1;
    verdict.requester.sequence = ++sequence_;
    verdict.requester.authentic = authentic;
    verdict.requester.stop = kind == OrderKind::kDisable;
    if (kind == OrderKind::kUseTable) verdict.table = std::make_unique<GainTable>(testing::demo_table());
    orders_.handle(verdict, now_ns_);
    return verdict;
  }
  /// The loop takes every order and accepts it; `replies`: and says so.
  void obey(bool replies) {
    Order order;
    while (loop_.joint(0).orders().pop(order)) {
      if (replies) (void)loop_.replies().push({order.id, Reason::kAccepted, Mode::kOff});
    }
  }
  int acceptances() {
    WireMessage message;
    std::uint64_t dropped = 0;
    int count = 0;
    while (memory_->messages.read(cursor_, message, dropped)) {
      const auto ack = decode_exactly<ack_v1>({message.bytes.data(), message.size});
      if (ack && ack->accepted == 1) ++count;
    }
    return count;
  }

  std::unique_ptr<OutboundMemory> memory_ = std::make_unique<OutboundMemory>();
  RealtimeLoop loop_{LoopConfig{}, one_joint(), memory_->states};
  Admission admission_{"SW", 1, {{"elbow", {}, -1.0, 1.0, 34.0, 6.0}}, {{}, true}};
  Answers answers_{"SW", 1, {"elbow"}, memory_->messages};
  PendingOrders orders_{loop_, admission_, answers_};
  std::int64_t now_ns_ = 0;
  std::int64_t sequence_ = 0;
  std::uint64_t cursor_ = 0;
};

TEST_F(PendingOrdersTest, AreAnsweredWhenTheLoopHasReplied) {
  order(OrderKind::kEnable, true);
  EXPECT_TRUE(orders_.waiting());
  obey(true);
  orders_.take_replies(now_ns_);
  EXPECT_FALSE(orders_.waiting());
  EXPECT_EQ(acceptances(), 1);
}

TEST_F(PendingOrdersTest, OfATableWhoseReplyIsLostLeaveTheBookFreeOnceAStateTells) {
  ASSERT_EQ(order(OrderKind::kUseTable, true).kind, Verdict::Kind::kOrder);
  obey(false);
  EXPECT_EQ(order(OrderKind::kUseTable, true).reason, Reason::kBusy);
  orders_.take_replies(now_ns_ += PendingOrders::kReplyTimeout_ns + 1);
  EXPECT_FALSE(orders_.waiting());
  EXPECT_EQ(order(OrderKind::kUseTable, true).reason, Reason::kBusy) << "the loop may still take it";
  StateRecord record{};
  record.state.cycle = 3;
  orders_.observe(record);
  EXPECT_EQ(order(OrderKind::kUseTable, true).kind, Verdict::Kind::kOrder);
}

TEST_F(PendingOrdersTest, OfStopsAreAnsweredHoweverManyAnswersStrangersHaveUsedUp) {
  for (int i = 0; i < 5000; ++i) {
    Verdict forgery;
    forgery.kind = Verdict::Kind::kRefuse;
    forgery.reason = Reason::kBadSignature;
    orders_.handle(forgery, now_ns_);
  }
  for (int stop = 0; stop < 5; ++stop) {
    order(OrderKind::kDisable);
    obey(true);
    orders_.take_replies(now_ns_ += kMillisecond_ns);
  }
  EXPECT_EQ(acceptances(), 5);
}

TEST_F(PendingOrdersTest, OfWhoProvesWhoHeIsAreAnsweredHoweverManyStopsAreForged) {
  for (int i = 0; i < 5000; ++i) {
    order(OrderKind::kDisable);
    obey(true);
    orders_.take_replies(now_ns_);
  }
  (void)acceptances();
  order(OrderKind::kDisable, true);
  obey(true);
  orders_.take_replies(now_ns_);
  EXPECT_EQ(acceptances(), 1);
}

}  // namespace
}  // namespace strainwave
