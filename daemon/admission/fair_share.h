// SPDX-License-Identifier: BSD-3-Clause
// Limits the average rate of an action, with a reserve for bursts: each action takes a token. The sources that ask share the tokens. A
// source that took more lately must leave more for the others, so a flooding source is refused and a new one is not. The last part of the
// reserve is kept for proven sources, the part before it for their addresses. Bounded memory. Time is an argument. Not for the loop.
//
// A source that took w tokens lately (each weighs exp(-age / 4 s)) gets another only if more tokens are left than
//   (burst / 2) w / (w + burst / 8) + burst / 8
// The last term is 0 for a proven source, and half as large for the address of one. The first token of a source thus raises its own
// threshold by about four. Let k sources take all they can after their first token. Together they get the average rate. A new source
// still finds a token while k is below two seconds' rate and below the number of remembered sources.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "base/token_bucket.h"

namespace strainwave {

class FairShare {
 public:
  /// Each source belongs to one row. In a full row, the one that took least is forgotten.
  static constexpr std::size_t kRows = 512;
  static constexpr std::size_t kTakersInRow = 8;
  /// Number of proven sources; beyond it the one with the oldest proof is forgotten.
  static constexpr std::size_t kProven = 64;

  /// For all sources together: average rate `per_second` > 0, and `burst` >= 1. `salt` keeps secret which sources share a row.
  FairShare(double per_second, double burst, std::uint64_t salt = std::random_device{}())
      : bucket_(per_second, burst), salt_(salt), takers_(kRows * kTakersInRow) {}

  /// Whether `source` (an address and 16 bits of port) may take a token at `now_ns`, which must not decrease.
  bool available(std::uint64_t source, std::int64_t now_ns) noexcept;
  /// `source` takes a token at `now_ns`.
  void take(std::uint64_t source, std::int64_t now_ns) noexcept;
  bool try_take(std::uint64_t source, std::int64_t now_ns) noexcept {
    const bool had_one = available(source, now_ns);
    if (had_one) take(source, now_ns);
    return had_one;
  }
  /// `source` proved its identity at `now_ns`.
  void prove(std::uint64_t source, std::int64_t now_ns) noexcept;

 private:
  struct Taker {
    std::uint64_t source = 0;
    double taken = 0.0;  ///< weighted number of tokens at `at_ns`
    std::int64_t at_ns = 0;
    double taken_by(std::int64_t now_ns) const noexcept;
  };
  struct Proof {
    std::uint64_t source = 0;
    std::int64_t at_ns = -1;  ///< -1: free
  };
  std::span<Taker> row_of(std::uint64_t source) noexcept;
  double kept_for_proven(std::uint64_t source) const noexcept;

  TokenBucket bucket_;
  std::uint64_t salt_;
  std::vector<Taker> takers_;
  std::array<Proof, kProven> proven_{};
};

}  // namespace strainwave
