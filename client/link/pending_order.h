// An order on its way: transmitted, and repeated until it is answered, for LCM may lose messages. The daemon answers a
// repetition as it answered the first. Not real-time.
#pragma once

#include <strainwave/ack_v1.hpp>
#include <string>

#include "client/link/clock.h"
#include "client/link/connection.h"
#include "client/link/sender.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

/// The daemon's answer to one order.
struct Answer {
  bool accepted = false;
  Reason reason = Reason::kAccepted;
  std::string text;        ///< the daemon's words, safe to print
  bool overtaken = false;  ///< a refusal of Client::send(): a later message of it came first
};

Answer to_answer(const ack_v1& ack);

class PendingOrder {
 public:
  static constexpr int kRepetitions = 3;

  /// Transmits `order` for the first time. `ack_channel`: where its answer comes from; `timeout_s`: how long it is given for the
  /// answer, repetitions included.
  PendingOrder(Connection& connection, SealedMessage order, std::string ack_channel, double timeout_s);

  /// Transmits it once more if its time has come. False when the last repetition has waited in vain, too.
  bool keep_on();

  /// Until keep_on() has something to do.
  int remaining_ms() const noexcept { return next_.remaining_ms(); }

  /// `ack`, which came on `channel`, is its answer.
  bool is_answer(const ack_v1& ack, const std::string& channel) const noexcept {
    return channel == ack_channel_ && ack.sender_id == order_.sender_id && ack.sequence == order_.sequence;
  }

 private:
  void transmit();

  Connection* connection_;
  SealedMessage order_;
  std::string ack_channel_;
  double repeat_s_;
  Deadline next_;
  int transmissions_ = 0;
};

}  // namespace strainwave
