// SPDX-License-Identifier: BSD-3-Clause
// Orders of one sender to joints of any daemon. Each is repeated until it is answered, while the program
// continues. Nothing here waits. Not real-time.
#pragma once

#include <functional>
#include <strainwave/ack_v1.hpp>
#include <string>
#include <utility>
#include <vector>

#include "client/protocol/pending_order.h"
#include "client/protocol/sender.h"

namespace strainwave {

class OpenOrders {
 public:
  using Name = std::pair<std::string, std::string>;  ///< prefix, joint
  /// Makes the message. It is called again when a higher sequence is needed.
  using Seal = std::function<SealedMessage()>;
  /// Called with the daemon's answer, or with null if none came.
  using Done = std::function<void(const Answer* answer)>;

  /// `sender` seals the posted messages, and must outlive this object.
  OpenOrders(PendingOrder::Publish publish, Sender& sender);

  /// Sends the message of `seal` to `joint`. Calls `done` at most once, from tick() or take(). If another program of this key was ahead,
  /// the daemon refuses the message unread; it is then sent again with a higher sequence, a few times. Throws the errors of `seal`.
  void post(const Name& joint, Seal seal, const Patience& patience, Done done);

  /// Drops the open orders to `joint`: they are not repeated, and their `done` is not called. A stop calls this first.
  void withdraw(const Name& joint);

  /// Repeats unanswered orders. Call it often.
  void tick();
  /// Takes an answer from `channel`.
  void take(const std::string& channel, const ack_v1& ack);

  std::size_t size() const noexcept { return waiting_.size(); }

 private:
  struct Waiting {
    Name joint;
    PendingOrder order;
    std::function<PendingOrder()> anew;  ///< the same order with the next sequence
    Done done;
    int renewals = 0;
  };
  bool renew(Waiting& waiting, const ack_v1& refusal);

  PendingOrder::Publish publish_;
  Sender& sender_;
  std::vector<Waiting> waiting_;
};

/// The name for people: PREFIX.JOINT.
std::string full_name(const OpenOrders::Name& joint);

}  // namespace strainwave
