// SPDX-License-Identifier: BSD-3-Clause
// Seals messages to the daemon: only this class fills in the sender, the session, the sequence and the
// signature. Not real-time.
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

/// The fields of a joint's state that an order must quote.
struct Quote {
  std::int64_t session_id = 0;
  std::int64_t challenge = 0;
};
template <typename State>
Quote quote_of(const State& state) {
  return {state.session_id, state.challenge};
}

/// A message ready for the network. Sending it twice sends the same order, because the sequence is part of it.
struct SealedMessage {
  std::string channel;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  std::vector<std::uint8_t> bytes;
};

class Sender {
 public:
  /// Takes the identity of this user on this machine, so that successive programs of the user own the same joints.
  /// `key_file`: the secret key, read before the first signature; empty: orders go out unsigned. `program`: the name
  /// of a program that owns joints for itself; empty: it shares them with the user's other programs.
  explicit Sender(std::filesystem::path key_file = {}, const std::string& program = "");
  explicit Sender(std::int64_t sender_id) : sender_id_(sender_id) {}

  std::int64_t sender_id() const noexcept { return sender_id_; }

  /// Completes `message` (a setpoint, command or table) for the quoted daemon and signs it. Throws InputError
  /// when the key cannot be used.
  template <typename Message>
  SealedMessage seal(std::string channel, const Message& message, const Quote& quote) {
    SealedMessage sealed = seal_unsigned(std::move(channel), message, quote);
    sign_if_keyed(sealed.channel, sealed.bytes);
    return sealed;
  }

  /// Seals a stop: signed if possible, otherwise unsigned. A problem with the key must not hold it back.
  template <typename Message>
  SealedMessage seal_stop(std::string channel, const Message& message, const Quote& quote) {
    SealedMessage sealed = seal_unsigned(std::move(channel), message, quote);
    try {
      sign_if_keyed(sealed.channel, sealed.bytes);
    } catch (const InputError&) {
      // The stop goes out unsigned.
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

  /// Returns a number for a stream of setpoints, unique among the streams of this sender.
  std::int64_t new_stream() noexcept { return next_sequence(utime_now()); }

  /// Sequences rise with the clock, in microseconds. No real answer of a daemon comes near this value.
  static constexpr std::int64_t kLargestSequence = std::int64_t{1} << 62;
  /// Makes the next sequence larger than `sequence`, after another program with this key was ahead. It
  /// ignores values from kLargestSequence on, which no daemon sends.
  void rise_above(std::int64_t sequence) noexcept {
    if (sequence < kLargestSequence) sequence_ = std::max(sequence_, sequence);
  }

 private:
  /// Larger than every earlier sequence of this sender. Through the clock, it also exceeds those of other programs with the key.
  std::int64_t next_sequence(std::int64_t utime) noexcept;
  void sign_if_keyed(const std::string& channel, std::span<std::uint8_t> bytes);

  std::int64_t sender_id_;
  std::int64_t sequence_ = 0;
  std::filesystem::path key_file_;
  std::optional<SecretKey> key_;
};

}  // namespace strainwave
