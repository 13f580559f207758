// SPDX-License-Identifier: BSD-3-Clause
// Orders on their way through the loop, without its thread: the test takes them and replies in the loop's place.
#include "daemon/admission/pending_orders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <strainwave/ack_v1.hpp>
#include <string>
#include <vector>

#include "control/table/gain_table_json.h"
#include "lcmtypes/wire.h"
#include "tests/support/joint_bench.h"
#include "tests/support/refusal.h"

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
    verdict.requester.stop = kind == OrderKind::kDisable || kind == OrderKind::kHold;
    verdict.requester.takes_over = kind == OrderKind::kEndStream;
    if (kind == OrderKind::kUseTable) verdict.table = std::make_unique<GainTable>(testing::demo_table());
    verdict.proves_box = false;  // at once, without the prover's thread
    orders_.handle(verdict, now_ns_);
    return verdict;
  }
  /// The loop takes every order. If `replies`, it answers that it accepts it.
  void obey(bool replies) {
    Order order;
    while (loop_.joint(0).orders().pop(order))
      if (replies) (void)loop_.replies().push({order.id, Reason::kAccepted, Mode::kOff});
  }
  /// The text of the refusal for the loop's `reply` to an order of this kind.
  std::string refusal(OrderKind kind, Reply reply) {
    order(kind, true);
    Order taken;
    EXPECT_TRUE(loop_.joint(0).orders().pop(taken));
    reply.id = taken.id;
    EXPECT_TRUE(loop_.replies().push(reply));
    orders_.take_replies(now_ns_);
    WireMessage message;
    std::uint64_t dropped = 0;
    std::string text;
    while (memory_->messages.read(cursor_, message, dropped))
      if (const auto ack = decode_exactly<ack_v1>({message.bytes.data(), message.size})) {
        const auto* end = std::find(std::begin(ack->text), std::end(ack->text), 0);
        text.assign(std::begin(ack->text), end);
        EXPECT_LT(text.size(), sizeof ack->text - 1) << "cut off: " << text;
      }
    return text;
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
  Admission admission_{"SW", 1, {{"elbow", {}, -1.0, 1.0, 6.0}}, {{}, true}};
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

TEST_F(PendingOrdersTest, ThatTheLoopRefusesByANumberSayTheNumberWhatIsAllowedAndTheKey) {
  using testing::expect_mentions;
  expect_mentions(refusal(OrderKind::kEnable, {0, Reason::kMoving, Mode::kOff, 3.6, 0.01}),
                  {"3.6 rad/s", "at most 0.01", "joint.supervision.standstill_rad_s"});
  expect_mentions(refusal(OrderKind::kSetpoint, {0, Reason::kOutOfRange, Mode::kHolding, 2.5, 1.0}),
                  {"at_cycle", "2.5 s", "at most 1 s"});
  expect_mentions(refusal(OrderKind::kSetpoint, {0, Reason::kCycleIsOver, Mode::kHolding, 8640012, 8640013}),
                  {"at_cycle = 8640012", "this is cycle 8640013", "8640014 or later"});
  std::string wrong;
  for (const double ratio : {57.31, -1.0, 50.0})  // degrees, the wrong sign, the motor of a gear
    wrong += refusal(OrderKind::kSetpoint, {0, Reason::kVelocitiesContradict, Mode::kTracking, ratio, 1.0});
  expect_mentions(wrong, {"is 57.31 times the rate", "as if in deg/s", "as if with the opposite sign",
                          "50 times the rate at which position_rad changes, and"});
  expect_mentions(refusal(OrderKind::kSetpoint, {0, Reason::kStreamEnded, Mode::kTracking, 13.1042, 12.0}),
                  {"the joint is tracking and yielded to a load of 13.1 N.m (joint.limits.load_Nm allows 12)",
                   "which ended this stream", "begin a new one once the joint holds"});
  expect_mentions(refusal(OrderKind::kUseTable, {0, Reason::kOutOfRange, Mode::kHolding, 8.0, 12.5}),
                  {"may hold a load of 8 N.m", "holds 12.5 N.m now", "a higher torque_limit_Nm"});
  expect_mentions(refusal(OrderKind::kResumePath, {0, Reason::kWrongMode, Mode::kHolding, 1.0, 2.0}),
                  {"the daemon has the path's parts for 1 of its 2 joints: send the others"});
}

TEST_F(PendingOrdersTest, ThatDoNothingInTheModeThatTheyMetSayWhatDoes) {
  const struct {
    OrderKind kind;
    Mode mode;
    std::string words;
  } cases[] = {
      {OrderKind::kHold, Mode::kOff, "the joint is off: it has no torque and no motion to stop; enable"},
      {OrderKind::kHold, Mode::kFaulted, "the joint is faulted: its drive is off already; clear the fault"},
      {OrderKind::kHold, Mode::kStopping, "it is stopping already"},
      {OrderKind::kSetpoint, Mode::kOff, "enable it first"},
      {OrderKind::kSetpoint, Mode::kHoming, "wait until it has found home"},
      {OrderKind::kSetpoint, Mode::kReleasing, "it is being enabled; wait until it holds"},
      {OrderKind::kEnable, Mode::kStopping, "it is being disabled; wait until it is off"},
      {OrderKind::kHome, Mode::kTracking, "homing begins at rest; hold it first"},
      {OrderKind::kClearFault, Mode::kTracking, "it has no fault to clear"},
  };
  for (const auto& one : cases) {
    const std::string text = refusal(one.kind, {0, Reason::kWrongMode, one.mode});
    EXPECT_NE(text.find(one.words), std::string::npos) << text;
  }
  EXPECT_NE(refusal(OrderKind::kSetpoint, {0, Reason::kMoving, Mode::kTracking}).find("it yields to a load"),
            std::string::npos);
  EXPECT_NE(refusal(OrderKind::kUseTable, {0, Reason::kMoving, Mode::kTracking}).find("at standstill"),
            std::string::npos);
}

TEST_F(PendingOrdersTest, ThatWaitedTooLongAreNotSaidToBeForAnotherCycle) {
  const std::string text = refusal(OrderKind::kSetpoint, {0, Reason::kTooOld, Mode::kHolding});
  EXPECT_NE(text.find("waited"), std::string::npos) << text;
  EXPECT_EQ(text.find("at_cycle"), std::string::npos) << text;
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

class TablesWithABox : public PendingOrdersTest {
 protected:
  TablesWithABox() { orders_.start(); }
  Verdict offer(const GainTable& table) {
    Verdict verdict;
    verdict.kind = Verdict::Kind::kOrder;
    verdict.order.kind = OrderKind::kUseTable;
    verdict.order.expires_cycle = 1;
    verdict.requester.authentic = true;
    verdict.requester.sequence = ++sequence_;
    verdict.table = std::make_unique<GainTable>(table);
    orders_.handle(verdict, now_ns_);
    return verdict;
  }
  GainTable table_ = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-0.178/c4.json");
};

TEST_F(TablesWithABox, AreProvedWhileStopsPass) {
  ASSERT_FALSE(table_.box.rigid());
  ASSERT_EQ(offer(table_).kind, Verdict::Kind::kOrder);
  order(OrderKind::kDisable, true);
  Order first;
  ASSERT_TRUE(loop_.joint(0).orders().pop(first));
  EXPECT_EQ(first.kind, OrderKind::kDisable);
  Order second;
  while (!loop_.joint(0).orders().pop(second)) orders_.take_replies(now_ns_);
  EXPECT_EQ(second.kind, OrderKind::kUseTable);
  EXPECT_GE(second.expires_cycle, admission_.order_lifetime_cycles())
      << "the proof's time is not the order's";
  EXPECT_EQ(loop_.joint(0).table_slot(static_cast<std::size_t>(second.table_slot)).table.name.view(),
            table_.name.view());
}

TEST_F(TablesWithABox, AreRefusedWhenTheirBoxIsNotProvedAndOneAtATime) {
  GainTable tampered = table_;
  for (double& entry : tampered.box.cells[0].P) entry = -entry;
  ASSERT_EQ(offer(tampered).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(offer(table_).reason, Reason::kBusy);
  std::optional<Verdict> refused;
  while (!refused) refused = orders_.take_replies(now_ns_);
  EXPECT_EQ(refused->reason, Reason::kTableNotCertified) << "the supervisor logs it";
  Order none;
  EXPECT_FALSE(loop_.joint(0).orders().pop(none));
  EXPECT_EQ(offer(table_).kind, Verdict::Kind::kOrder) << "the prover is free again";
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

TEST_F(PendingOrdersTest, LeaveStopsTheirPlacesHoweverManyOrdersWait) {
  int passed = 0;
  while (order(OrderKind::kEnable, true).kind == Verdict::Kind::kOrder && passed < 1000) ++passed;
  EXPECT_EQ(passed, static_cast<int>(kMostWaitingOrders - PendingOrders::kPlacesForStops));
  for (const OrderKind stop : {OrderKind::kHold, OrderKind::kDisable})
    EXPECT_EQ(order(stop).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(order(OrderKind::kEnable, true).reason, Reason::kBusy);
}

TEST_F(PendingOrdersTest, AreOneForTheLoopWhenTheyAreEqualStopsAndAllAreAnsweredByItsReply) {
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(order(OrderKind::kDisable, i % 3 == 0).kind, Verdict::Kind::kOrder) << i;
    EXPECT_EQ(order(OrderKind::kHold, true).kind, Verdict::Kind::kOrder) << i;
  }
  Order taken;
  int count = 0;
  while (loop_.joint(0).orders().pop(taken)) {
    ++count;
    (void)loop_.replies().push({taken.id, Reason::kAccepted, Mode::kOff});
    EXPECT_EQ(acceptances(), 0) << "none before the loop's reply";
  }
  EXPECT_EQ(count, 2);
  orders_.take_replies(now_ns_);
  EXPECT_FALSE(orders_.waiting());
  EXPECT_EQ(acceptances(), 120);
}

TEST_F(PendingOrdersTest, ThatFollowAStopLetAnEqualOneAfterThemThrough) {
  const auto waiting = [this] {
    std::vector<OrderKind> kinds;
    for (Order order; loop_.joint(0).orders().pop(order);) kinds.push_back(order.kind);
    return kinds;
  };
  using Kinds = std::vector<OrderKind>;
  order(OrderKind::kHold);
  order(OrderKind::kEnable);
  order(OrderKind::kHold);
  order(OrderKind::kHold);
  EXPECT_EQ(waiting(), (Kinds{OrderKind::kHold, OrderKind::kEnable, OrderKind::kHold}));
  obey(true);
  orders_.take_replies(now_ns_ += PendingOrders::kReplyTimeout_ns + 1);
  order(OrderKind::kHold);
  EXPECT_EQ(waiting(), Kinds{OrderKind::kHold}) << "the ones before were given up";
}

TEST_F(PendingOrdersTest, ThatTakeAJointOverDoSoOnceTheStreamsEndIsUnderWay) {
  while (order(OrderKind::kEnable, true).kind == Verdict::Kind::kOrder) {
  }
  EXPECT_EQ(order(OrderKind::kEndStream, true).reason, Reason::kBusy);
  EXPECT_EQ(admission_.ownership().owner_id(0, now_ns_), 0) << "the stream goes on, with its owner";
  obey(false);
  EXPECT_EQ(order(OrderKind::kEndStream, true).kind, Verdict::Kind::kOrder);
  EXPECT_EQ(admission_.ownership().owner_id(0, now_ns_), 1);
}

}  // namespace
}  // namespace strainwave
