// SPDX-License-Identifier: BSD-3-Clause
// Seals messages to the daemon: the one place that fills in who sends, for which session, in which order, and
// the signature. Not real-time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "base/utime.h"
#include "lcmtypes/signing.h"
#include "lcmtypes/wire.h"

namespace strainwave {

/// What of a joint's state an order must quote.
struct Quote {
  std::int64_t session_id = 0;
  std::int64_t challenge = 0;
};
template <typename State>
Quote quote_of(const State& state) {
  return {state.session_id, state.challenge};
}

/// A message ready for the wire. Sending it twice sends the same order: the sequence is part of it.
struct SealedMessage {
  std::string channel;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  std::vector<std::uint8_t> bytes;
};

class Sender {
 public:
  /// Takes the identity of this user on this machine: programs of theirs that follow each other own the same joints.
  /// `key_file`: the secret key to sign with, read when the first order is signed; empty: orders go out unsigned.
  /// `program`: one that owns joints for itself; empty: it shares them with others of this user.
  explicit Sender(std::filesystem::path key_file = {}, const std::string& program = "");
  explicit Sender(std::int64_t sender_id) : sender_id_(sender_id) {}

  std::int64_t sender_id() const noexcept { return sender_id_; }

  /// Completes `message` (a setpoint, command or table) for the daemon that is quoted and signs it. Throws
  /// InputError when the key cannot be used.
  template <typename Message>
  SealedMessage seal(std::string channel, const Message& message, const Quote& quote) {
    SealedMessage sealed = seal_unsigned(std::move(channel), message, quote);
    sign_if_keyed(sealed.channel, sealed.bytes);
    return sealed;
  }

  /// A stop: signed if that is possible, as it is if not. No trouble with a key may keep it back.
  template <typename Message>
  SealedMessage seal_stop(std::string channel, const Message& message, const Quote& quote) {
    SealedMessage sealed = seal_unsigned(std::move(channel), message, quote);
    try {
      sign_if_keyed(sealed.channel, sealed.bytes);
    } catch (const InputError&) {
      // unsigned, then
    }
    return sealed;
  }

  /// The same without a signature.
  template <typename Message>
  SealedMessage seal_unsigned(std::string channel, Message message, const Quote& quote) {
    message.utime = utime_now();
    message.session_id = quote.session_id;
    message.challenge = quote.challenge;
    message.sender_id = sender_id_;
    message.sequence = next_sequence(message.utime);
    return {std::move(channel), message.sender_id, message.sequence, encode(message)};
  }

  /// A number for a stream of setpoints that no other stream of this sender has.
  std::int64_t new_stream() noexcept { return next_sequence(utime_now()); }

  /// Sequences rise with the clock, in microseconds; nothing that a daemon answers comes near this.
  static constexpr std::int64_t kLargestSequence = std::int64_t{1} << 62;
  /// The next order's sequence is above `sequence`: another program of this key was ahead. What leaves no room above it
  /// is no daemon's answer.
  void rise_above(std::int64_t sequence) noexcept {
    if (sequence < kLargestSequence) sequence_ = std::max(sequence_, sequence);
  }

 private:
  /// Rises over everything that is sent, and with the clock over all programs of one key.
  std::int64_t next_sequence(std::int64_t utime) noexcept;
  void sign_if_keyed(const std::string& channel, std::span<std::uint8_t> bytes);

  std::int64_t sender_id_;
  std::int64_t sequence_ = 0;
  std::filesystem::path key_file_;
  std::optional<SecretKey> key_;
};

}  // namespace strainwave
