// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/signing.h"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace strainwave {

namespace {

static_assert(sizeof(PublicKey::bytes) == crypto_sign_PUBLICKEYBYTES);
static_assert(sizeof(Signature) == crypto_sign_BYTES);
static_assert(sizeof(SecretKey::Seed) == crypto_sign_SEEDBYTES);

void require_sodium() {
  static const int result = ::sodium_init();
  if (result < 0) throw std::runtime_error("libsodium cannot be initialised");
}

std::vector<std::uint8_t> signed_part(std::string_view channel, std::span<const std::uint8_t> message) {
  std::vector<std::uint8_t> part(channel.begin(), channel.end());
  part.push_back(0);
  const auto body = message.first(message.size() - kSealBytes);
  part.insert(part.end(), body.begin(), body.end());
  return part;
}

}  // namespace

KeyId PublicKey::id() const noexcept {
  KeyId id;
  std::copy_n(bytes.begin(), id.size(), id.begin());
  return id;
}

bool PublicKey::is_valid() const noexcept {
  return ::crypto_core_ed25519_is_valid_point(bytes.data()) == 1;
}

SecretKey SecretKey::generate() {
  require_sodium();
  SecretKey key;
  PublicKey unused;
  ::crypto_sign_keypair(unused.bytes.data(), key.bytes_.data());
  return key;
}

SecretKey::SecretKey(const Seed& seed) {
  require_sodium();
  PublicKey unused;
  ::crypto_sign_seed_keypair(unused.bytes.data(), bytes_.data(), seed.data());
}

SecretKey::~SecretKey() {
  ::sodium_memzero(bytes_.data(), bytes_.size());
}

SecretKey::Seed SecretKey::seed() const noexcept {
  Seed seed;
  ::crypto_sign_ed25519_sk_to_seed(seed.data(), bytes_.data());
  return seed;
}

PublicKey SecretKey::public_key() const noexcept {
  PublicKey key;
  ::crypto_sign_ed25519_sk_to_pk(key.bytes.data(), bytes_.data());
  return key;
}

void sign(std::string_view channel, const SecretKey& key, std::span<std::uint8_t> message) {
  if (message.size() < kSealBytes) return;
  require_sodium();
  const std::vector<std::uint8_t> part = signed_part(channel, message);
  const auto seal = message.last(kSealBytes);
  const KeyId id = key.public_key().id();
  std::copy(id.begin(), id.end(), seal.begin());
  ::crypto_sign_detached(seal.data() + id.size(), nullptr, part.data(), part.size(), key.bytes().data());
}

bool is_unsigned(std::span<const std::uint8_t> message) noexcept {
  const auto seal = message.last(std::min(message.size(), kSealBytes));
  return std::all_of(seal.begin(), seal.end(), [](std::uint8_t byte) { return byte == 0; });
}

KeyId key_id_of(std::span<const std::uint8_t> message) noexcept {
  KeyId id{};
  if (message.size() >= kSealBytes) std::copy_n(message.last(kSealBytes).begin(), id.size(), id.begin());
  return id;
}

bool verify(std::string_view channel, const PublicKey& key, std::span<const std::uint8_t> message) {
  if (message.size() < kSealBytes) return false;
  require_sodium();
  const std::vector<std::uint8_t> part = signed_part(channel, message);
  const auto signature = message.last(sizeof(Signature));
  return ::crypto_sign_verify_detached(signature.data(), part.data(), part.size(), key.bytes.data()) == 0;
}

}  // namespace strainwave
