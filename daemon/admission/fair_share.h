// SPDX-License-Identifier: BSD-3-Clause
// Bounds how often something may happen on the average, with a reserve for bursts, and shares it among the sources that ask. A source
// that took more lately must leave more for the others: one that floods is refused, and a new one is not. The last of the reserve is kept
// for proven sources, and the part before it for the addresses of proven sources. Bounded memory. Time is an argument. Not for the loop.
//
// A source that took w within the last seconds (each counts for exp(-age / 4 s)) gets another one only where more is left than
//   (burst / 2) w / (w + burst / 8) + burst / 8
// without the last burst / 8 for a proven source, and with half of it for the address of one. The first one that a source takes so weighs
// four. Let k sources take all they can, once each has had its first. Together they get the rate. A new source finds enough as long as k
// is below two seconds' rate and below the number of remembered sources.
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
  /// A source has its place in one of the rows; where that is full, the one that took the least is forgotten.
  static constexpr std::size_t kRows = 512;
  static constexpr std::size_t kTakersInRow = 8;
  /// Beyond it the one whose proof is oldest is.
  static constexpr std::size_t kProven = 64;

  /// `per_second` > 0 on the average, `burst` >= 1 at once, of all sources together. `salt`: keeps secret which sources share a row.
  FairShare(double per_second, double burst, std::uint64_t salt = std::random_device{}())
      : bucket_(per_second, burst), salt_(salt), takers_(kRows * kTakersInRow) {}

  /// Whether `source` (an address, and 16 bits of a port) may have one at `now_ns`; the clock may stand still but not go back.
  bool available(std::uint64_t source, std::int64_t now_ns) noexcept;
  /// `source` has had one at `now_ns`.
  void take(std::uint64_t source, std::int64_t now_ns) noexcept;
  bool try_take(std::uint64_t source, std::int64_t now_ns) noexcept {
    const bool had_one = available(source, now_ns);
    if (had_one) take(source, now_ns);
    return had_one;
  }
  /// `source` has shown at `now_ns` who it is.
  void prove(std::uint64_t source, std::int64_t now_ns) noexcept;

 private:
  struct Taker {
    std::uint64_t source = 0;
    double taken = 0.0;  ///< at `at_ns`, each with its weight
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
