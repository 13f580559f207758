// SPDX-License-Identifier: BSD-3-Clause
// An open order: it is transmitted, and repeated until it is answered, because LCM may lose messages. The
// daemon gives a repetition the answer of the first. Not real-time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <strainwave/ack_v1.hpp>
#include <string>

#include "client/protocol/clock.h"
#include "client/protocol/sender.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

/// The daemon's answer to one order.
struct Answer {
  bool accepted = false;
  Reason reason = Reason::kAccepted;
  std::string text;        ///< the daemon's explanation, safe to print
  bool overtaken = false;  ///< refusal of a message of Client::send(), because a later one arrived first
};

Answer to_answer(const ack_v1& ack);
/// The reason why an order was not accepted: "refused, joint is moving: ..."; for null "no answer".
std::string why_not(const Answer* answer);

/// Largest number of transmissions of an order, and the total time for its answer.
struct Patience {
  int transmissions;
  double timeout_s;
};

class PendingOrder {
 public:
  /// Puts a message on LCM's network.
  using Publish = std::function<void(const std::string& channel, std::span<const std::uint8_t> bytes)>;

  static constexpr int kRepetitions = 3;
  /// The daemon refuses commands older than about this. A later repetition cannot replace a lost message.
  static constexpr double kOrderLifetime_s = 1.0;
  /// Transmissions of an order of this size: four for each second of the time-out, plus one for each further
  /// Ethernet packet. The loss of any packet loses the message. At a loss of 1 packet in 10, four transmissions
  /// of a path's part would leave 1 of 14 unanswered. These leave 1 of 350, and of commands 1 of 770.
  static Patience patience(std::size_t bytes, double timeout_s) noexcept {
    constexpr std::size_t kPacketBytes = 1472;  // 1500 less the headers of IP and UDP
    const std::size_t packets = std::max<std::size_t>(1, (bytes + kPacketBytes - 1) / kPacketBytes);
    return {static_cast<int>(packets + kRepetitions) * lifetimes(timeout_s, kOrderLifetime_s), timeout_s};
  }
  /// The daemon needs 2 to 3 s to replace a hung gateway, which loses its unread messages. A stop is repeated for longer than that.
  static constexpr int kStopTransmissions = 8;
  static constexpr double kStopPatience_s = 4.0;
  static Patience stop_patience(double timeout_s) noexcept {
    return {kStopTransmissions * lifetimes(timeout_s, kStopPatience_s), std::max(timeout_s, kStopPatience_s)};
  }

  /// Transmits `order` for the first time. Its answer comes on `ack_channel`.
  PendingOrder(Publish publish, SealedMessage order, std::string ack_channel, const Patience& patience);

  /// Transmits the order again when it is due. Returns false when the last repetition also got no answer in time.
  bool keep_on();

  /// Time until keep_on() has to act.
  int remaining_ms() const noexcept { return next_.remaining_ms(); }

  /// Whether `ack`, received on `channel`, is the answer to this order.
  bool is_answer(const ack_v1& ack, const std::string& channel) const noexcept {
    return channel == ack_channel_ && ack.sender_id == order_.sender_id && ack.sequence == order_.sequence;
  }

 private:
  static int lifetimes(double timeout_s, double lifetime_s) noexcept {
    constexpr double kMost = 1e6;  // keeps the product with the transmissions within int
    return static_cast<int>(std::clamp(std::ceil(timeout_s / lifetime_s), 1.0, kMost));
  }
  void transmit();

  Publish publish_;
  SealedMessage order_;
  std::string ack_channel_;
  int most_transmissions_;
  double repeat_s_;
  Deadline next_;
  int transmissions_ = 0;
};

}  // namespace strainwave
