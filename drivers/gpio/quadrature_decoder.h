// SPDX-License-Identifier: BSD-3-Clause
// Counts of an incremental encoder from the edges of its two lines, four per signal period. Pure, real-time safe.
//
// A leads B in the direction of rising counts:
//   A  _/‾‾\__/‾‾\_      B  ___/‾‾\__/‾‾
// Every edge must change its line, follow its predecessor in sequence, and keep below the maximum rate. A
// violation is a fault; the count is then meaningless until reset().
#pragma once

#include <cstdint>

#include "drivers/gpio/edge_events.h"

namespace strainwave {

enum class QuadratureFault : std::int32_t {
  kNone = 0,
  kIllegalEdge = 1,  ///< a line changed to the level that it had: an edge is missing
  kLostEvents = 2,   ///< a gap in the kernel's sequence, or levels without an edge
  kOverSpeed = 3,    ///< faster than the maximum rate
  kDeviceGone = 4,   ///< the kernel refuses to read
};

class QuadratureDecoder {
 public:
  /// Edges allowed at once: a mechanical vibration around an edge is not a high speed.
  static constexpr double kBurst_edges = 16.0;

  explicit QuadratureDecoder(double max_rate_Hz) noexcept : max_rate_Hz_(max_rate_Hz) {}

  /// Takes the present levels and the sequence of the last edge. Ends a fault and keeps the count.
  void reset(bool a, bool b, std::uint32_t last_sequence) noexcept;
  QuadratureFault apply(const Edge& edge) noexcept;
  void fail(QuadratureFault fault) noexcept { fault_ = fault_ == QuadratureFault::kNone ? fault : fault_; }

  std::int64_t count() const noexcept { return count_; }
  QuadratureFault fault() const noexcept { return fault_; }
  std::uint32_t levels() const noexcept { return (a_ ? 1U : 0U) | (b_ ? 2U : 0U); }

 private:
  bool too_fast(std::int64_t time_ns) noexcept;

  double max_rate_Hz_;
  std::int64_t count_ = 0;
  std::uint32_t sequence_ = 0;
  std::int64_t last_ns_ = 0;
  double allowance_edges_ = kBurst_edges;
  QuadratureFault fault_ = QuadratureFault::kNone;
  bool a_ = false;
  bool b_ = false;
};

}  // namespace strainwave
