// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/quadrature_decoder.h"

#include <algorithm>

#include "base/durations.h"

namespace strainwave {

void QuadratureDecoder::reset(bool a, bool b, std::uint32_t last_sequence) noexcept {
  a_ = a;
  b_ = b;
  sequence_ = last_sequence;
  allowance_edges_ = kBurst_edges;
  fault_ = QuadratureFault::kNone;
}

// A token bucket that fills at the maximum rate and holds one burst.
bool QuadratureDecoder::too_fast(std::int64_t time_ns) noexcept {
  const double elapsed_s = seconds(std::max<std::int64_t>(0, time_ns - last_ns_));
  last_ns_ = time_ns;
  allowance_edges_ = std::min(kBurst_edges, allowance_edges_ + elapsed_s * max_rate_Hz_) - 1.0;
  return allowance_edges_ < 0.0;
}

QuadratureFault QuadratureDecoder::apply(const Edge& edge) noexcept {
  if (fault_ != QuadratureFault::kNone) return fault_;
  if (edge.sequence != sequence_ + 1) return fault_ = QuadratureFault::kLostEvents;
  sequence_ = edge.sequence;
  bool& line = edge.line == 0 ? a_ : b_;
  if (line == edge.active) return fault_ = QuadratureFault::kIllegalEdge;
  if (too_fast(edge.time_ns)) return fault_ = QuadratureFault::kOverSpeed;
  line = edge.active;
  // In forward motion the levels differ after an edge of A and are equal after an edge of B.
  const bool forward = edge.line == 0 ? a_ != b_ : a_ == b_;
  count_ += forward ? 1 : -1;
  return QuadratureFault::kNone;
}

}  // namespace strainwave
