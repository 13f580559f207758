#include "client/link/sender.h"

#include <algorithm>
#include <random>

#include "client/link/key_file.h"

namespace strainwave {

namespace {

/// 62 random bits from the operating system, never 0.
std::int64_t random_identity() {
  std::random_device entropy;
  const std::uint64_t bits = (std::uint64_t{entropy()} << 32 | entropy()) >> 2;
  return static_cast<std::int64_t>(bits) + 1;
}

}  // namespace

Sender::Sender(std::filesystem::path key_file)
    : sender_id_(random_identity()), key_file_(std::move(key_file)) {}

std::int64_t Sender::next_sequence(std::int64_t utime) noexcept {
  sequence_ = std::max(sequence_ + 1, utime);
  return sequence_;
}

void Sender::sign_if_keyed(const std::string& channel, std::span<std::uint8_t> bytes) {
  if (!key_ && !key_file_.empty()) key_ = read_secret_key(key_file_).key;
  if (key_) sign(channel, *key_, bytes);
}

}  // namespace strainwave
