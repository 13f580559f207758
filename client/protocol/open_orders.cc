// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/open_orders.h"

#include <algorithm>

#include "client/protocol/client.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

constexpr int kRenewals = Client::kAttempts - 1;

}  // namespace

OpenOrders::OpenOrders(PendingOrder::Publish publish, Sender& sender)
    : publish_(std::move(publish)), sender_(sender) {}

void OpenOrders::post(const Name& joint, Seal seal, const Patience& patience, Done done) {
  const auto send = [this, seal = std::move(seal), patience,
                     to = channel(joint.first, joint.second, channel_kind::kAck)] {
    return PendingOrder(publish_, seal(), to, patience);
  };
  waiting_.push_back({joint, send(), send, std::move(done), 0});
}

void OpenOrders::withdraw(const Name& joint) {
  std::erase_if(waiting_, [&](const Waiting& waiting) { return waiting.joint == joint; });
}

void OpenOrders::tick() {
  std::vector<Done> silent;
  std::erase_if(waiting_, [&](Waiting& waiting) {
    if (waiting.order.keep_on()) return false;
    silent.push_back(std::move(waiting.done));
    return true;
  });
  for (const Done& done : silent) done(nullptr);
}

void OpenOrders::take(const std::string& channel, const ack_v1& ack) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return waiting.order.is_answer(ack, channel);
  });
  if (found == waiting_.end()) return;
  if (ack.accepted != 1 && renew(*found, ack)) return;
  const Done done = std::move(found->done);
  waiting_.erase(found);
  const Answer answer = to_answer(ack);
  done(&answer);
}

// Another program with this key was ahead. The new message quotes the same state as the first one.
bool OpenOrders::renew(Waiting& waiting, const ack_v1& refusal) {
  if (static_cast<Reason>(refusal.reason) != Reason::kOldSequence || waiting.renewals >= kRenewals)
    return false;
  ++waiting.renewals;
  sender_.rise_above(refusal.last_sequence);
  waiting.order = waiting.anew();
  return true;
}

std::string full_name(const OpenOrders::Name& joint) {
  return joint.first + "." + joint.second;
}

}  // namespace strainwave
