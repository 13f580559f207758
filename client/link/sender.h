// Seals messages to the daemon: the one place that fills in who sends, for which session, in which order, and
// the signature. Not real-time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/utime.h"
#include "lcmtypes/signing.h"
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
  /// Takes a random identity that no other sender has. `key_file`: the secret key to sign with, read when the
  /// first order is signed; empty: orders go out unsigned.
  explicit Sender(std::filesystem::path key_file = {});
  explicit Sender(std::int64_t sender_id) : sender_id_(sender_id) {}

  std::int64_t sender_id() const noexcept { return sender_id_; }

  /// Completes `message` (a setpoint, command or table) for the daemon of `session_id` and signs it. Throws
  /// InputError when the key cannot be used.
  template <typename Message>
  SealedMessage seal(std::string channel, const Message& message, std::int64_t session_id) {
    SealedMessage sealed = seal_unsigned(std::move(channel), message, session_id);
    sign_if_keyed(sealed.channel, sealed.bytes);
    return sealed;
  }

  /// The same without a signature, for a stop: it needs none, and no trouble with a key may keep it back.
  template <typename Message>
  SealedMessage seal_unsigned(std::string channel, Message message, std::int64_t session_id) {
    message.utime = utime_now();
    message.session_id = session_id;
    message.sender_id = sender_id_;
    message.sequence = next_sequence(message.utime);
    return {std::move(channel), message.sender_id, message.sequence, encode(message)};
  }

 private:
  /// Rises, and never falls behind the clock: the daemon remembers only the latest senders of a key, and
  /// believes a new one only above those it has forgotten.
  std::int64_t next_sequence(std::int64_t utime) noexcept;
  void sign_if_keyed(const std::string& channel, std::span<std::uint8_t> bytes);

  std::int64_t sender_id_;
  std::int64_t sequence_ = 0;
  std::filesystem::path key_file_;
  std::optional<SecretKey> key_;
};

}  // namespace strainwave
