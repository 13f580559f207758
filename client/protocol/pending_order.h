// SPDX-License-Identifier: BSD-3-Clause
// An order on its way: transmitted, and repeated until it is answered, for LCM may lose messages. The daemon answers a
// repetition as it answered the first. Not real-time.
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
  std::string text;        ///< the daemon's words, safe to print
  bool overtaken = false;  ///< a refusal of Client::send(): a later message of it came first
};

Answer to_answer(const ack_v1& ack);
/// Of an answer that is no acceptance: "refused, joint is moving: ..."; null: "no answer".
std::string why_not(const Answer* answer);

/// How often an order is sent at the most, and how long its answer is awaited, repetitions included.
struct Patience {
  int transmissions;
  double timeout_s;
};

class PendingOrder {
 public:
  /// Puts a message on LCM's network.
  using Publish = std::function<void(const std::string& channel, std::span<const std::uint8_t> bytes)>;

  static constexpr int kRepetitions = 3;
  /// The daemon refuses a command that is older than about this: a repetition that comes later cannot replace what was lost.
  static constexpr double kOrderLifetime_s = 1.0;
  /// How often an order of so many bytes is sent before it is given up: four times in each second of the time-out, and once more for each
  /// further packet of Ethernet. A message is lost with any one of its packets. At a loss of 1 packet in 10, four transmissions of a path's
  /// part would leave 1 of 14 without an answer. These leave 1 of 350, and of commands 1 of 770.
  static Patience patience(std::size_t bytes, double timeout_s) noexcept {
    constexpr std::size_t kPacketBytes = 1472;  // of 1500, without the headers of IP and UDP
    const std::size_t packets = std::max<std::size_t>(1, (bytes + kPacketBytes - 1) / kPacketBytes);
    return {static_cast<int>(packets + kRepetitions) * lifetimes(timeout_s, kOrderLifetime_s), timeout_s};
  }
  /// A stop is also repeated for longer than the daemon takes to replace a gateway that hangs, 2 to 3 s: what that one had not read is lost.
  static constexpr int kStopTransmissions = 8;
  static constexpr double kStopPatience_s = 4.0;
  static Patience stop_patience(double timeout_s) noexcept {
    return {kStopTransmissions * lifetimes(timeout_s, kStopPatience_s), std::max(timeout_s, kStopPatience_s)};
  }

  /// Transmits `order` for the first time. `ack_channel`: where its answer comes from.
  PendingOrder(Publish publish, SealedMessage order, std::string ack_channel, const Patience& patience);

  /// Transmits it once more if its time has come. False when the last repetition has waited in vain, too.
  bool keep_on();

  /// Until keep_on() has something to do.
  int remaining_ms() const noexcept { return next_.remaining_ms(); }

  /// `ack`, which came on `channel`, is its answer.
  bool is_answer(const ack_v1& ack, const std::string& channel) const noexcept {
    return channel == ack_channel_ && ack.sender_id == order_.sender_id && ack.sequence == order_.sequence;
  }

 private:
  static int lifetimes(double timeout_s, double lifetime_s) noexcept {
    constexpr double kMost = 1e6;  // an int yet, with 9 or more in each
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
