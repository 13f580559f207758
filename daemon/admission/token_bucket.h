// Bounds how often something may happen on the average, with a reserve for bursts. Time is an argument. Not
// for the loop.
#pragma once

#include <algorithm>
#include <cstdint>

namespace strainwave {

class TokenBucket {
 public:
  TokenBucket(double per_second, double burst) : per_ns_(per_second * 1e-9), burst_(burst), tokens_(burst) {}

  /// Whether one is left at `now_ns`; the clock may stand still but not go back.
  bool available(std::int64_t now_ns) noexcept {
    if (now_ns > last_ns_) {
      tokens_ = std::min(burst_, tokens_ + static_cast<double>(now_ns - last_ns_) * per_ns_);
      last_ns_ = now_ns;
    }
    return tokens_ >= 1.0;
  }
  void take() noexcept { tokens_ -= 1.0; }
  bool try_take(std::int64_t now_ns) noexcept {
    const bool had_one = available(now_ns);
    if (had_one) take();
    return had_one;
  }

 private:
  double per_ns_;
  double burst_;
  double tokens_;
  std::int64_t last_ns_ = 0;
};

}  // namespace strainwave
