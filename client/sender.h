// Seals messages to the daemon: the one place that fills in who sends, for which session, in which order, and
// (once keys exist) the signature. Not real-time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/clock.h"
#include "lcmtypes/wire.h"

namespace strainwave {

/// A message ready for the wire. Sending it twice sends the same order: the sequence is part of it.
struct SealedMessage {
  std::string channel;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  std::vector<std::uint8_t> bytes;
};

class Sender {
 public:
  /// Takes a random identity that no other sender has.
  Sender();
  explicit Sender(std::int64_t sender_id) : sender_id_(sender_id) {}

  std::int64_t sender_id() const noexcept { return sender_id_; }

  /// Completes `message` (a setpoint, command or table) for the daemon of `session_id`. key_id and signature
  /// stay zero: unsigned.
  template <typename Message>
  SealedMessage seal(std::string channel, Message message, std::int64_t session_id) {
    message.utime = utime_us();
    message.session_id = session_id;
    message.sender_id = sender_id_;
    message.sequence = ++sequence_;
    return {std::move(channel), message.sender_id, message.sequence, encode(message)};
  }

 private:
  std::int64_t sender_id_;
  std::int64_t sequence_ = 0;
};

}  // namespace strainwave
