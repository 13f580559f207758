// SPDX-License-Identifier: BSD-3-Clause
// Orders of one sender to joints of any daemon, each of them repeated until it is answered, while the program does something else.
// It waits for nothing. Not real-time.
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
  /// Makes the message; called again where it needs a higher sequence.
  using Seal = std::function<SealedMessage()>;
  /// The daemon's answer; null: none came.
  using Done = std::function<void(const Answer* answer)>;

  /// `sender` has sealed, and will seal, what is posted; it must outlive this.
  OpenOrders(PendingOrder::Publish publish, Sender& sender);

  /// Sends what `seal` makes to `joint` and calls `done` at most once: from tick() or take(). What is refused unread, since another program of
  /// this key was ahead, is sent with a higher sequence, a few times. Throws what `seal` throws.
  void post(const Name& joint, Seal seal, const Patience& patience, Done done);

  /// Drops what waits for an answer of `joint`: it is not repeated, and its `done` is not called. A stop does so first.
  void withdraw(const Name& joint);

  /// Repeats what was not answered. Call often.
  void tick();
  /// An answer that came on `channel`.
  void take(const std::string& channel, const ack_v1& ack);

  std::size_t size() const noexcept { return waiting_.size(); }

 private:
  struct Waiting {
    Name joint;
    PendingOrder order;
    std::function<PendingOrder()> anew;  ///< the same with the next sequence
    Done done;
    int renewals = 0;
  };
  bool renew(Waiting& waiting, const ack_v1& refusal);

  PendingOrder::Publish publish_;
  Sender& sender_;
  std::vector<Waiting> waiting_;
};

/// As people read it.
std::string full_name(const OpenOrders::Name& joint);

}  // namespace strainwave
