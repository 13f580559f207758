// SPDX-License-Identifier: BSD-3-Clause
// Signatures of orders (Ed25519, libsodium). The signature covers the channel's name, a zero byte, and every encoded byte before
// key_id. So an order for one joint is not valid for another, and no byte of it can be changed. The key_id and the signature
// are the last 72 bytes of every order (setpoint_v1, path_v1, command_v1, gain_table_v1, inject_v1). Not real-time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace strainwave {

/// First bytes of the public key. They select the key that the daemon tries, and prove nothing by themselves.
using KeyId = std::array<std::uint8_t, 8>;
using Signature = std::array<std::uint8_t, 64>;

/// key_id and signature at the end of a message.
inline constexpr std::size_t kSealBytes = sizeof(KeyId) + sizeof(Signature);

struct PublicKey {
  std::array<std::uint8_t, 32> bytes{};

  KeyId id() const noexcept;
  /// Whether the bytes are a public key. A point of small order is none, because it has no secret key.
  bool is_valid() const noexcept;
  bool operator==(const PublicKey&) const = default;
};

/// A secret key; the destructor wipes its bytes.
class SecretKey {
 public:
  using Seed = std::array<std::uint8_t, 32>;

  /// Makes a key from the operating system's entropy.
  static SecretKey generate();
  explicit SecretKey(const Seed& seed);
  ~SecretKey();
  SecretKey(const SecretKey&) = default;
  SecretKey& operator=(const SecretKey&) = default;

  /// The part that is kept in a file.
  Seed seed() const noexcept;
  PublicKey public_key() const noexcept;
  const std::array<std::uint8_t, 64>& bytes() const noexcept { return bytes_; }

 private:
  SecretKey() = default;
  std::array<std::uint8_t, 64> bytes_{};
};

/// Fills the last 72 bytes of `message`, which goes out on `channel`. Leaves a shorter message unchanged.
void sign(std::string_view channel, const SecretKey& key, std::span<std::uint8_t> message);

/// Whether key_id and signature are all zero: the sender did not sign.
bool is_unsigned(std::span<const std::uint8_t> message) noexcept;

/// Returns the key_id in `message`, or zeros when it is too short to have one.
KeyId key_id_of(std::span<const std::uint8_t> message) noexcept;

/// Whether the owner of `key` sent exactly this message on exactly this channel. Costs about 0.1 ms.
bool verify(std::string_view channel, const PublicKey& key, std::span<const std::uint8_t> message);

}  // namespace strainwave
