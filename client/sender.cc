#include "client/sender.h"

#include <random>

namespace strainwave {

namespace {

/// 62 random bits from the operating system, never 0.
std::int64_t random_identity() {
  std::random_device entropy;
  const std::uint64_t bits = (std::uint64_t{entropy()} << 32 | entropy()) >> 2;
  return static_cast<std::int64_t>(bits) + 1;
}

}  // namespace

Sender::Sender() : sender_id_(random_identity()) {}

}  // namespace strainwave
