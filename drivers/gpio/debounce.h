// SPDX-License-Identifier: BSD-3-Clause
// Debounces digital inputs: a level must be steady for a while before it is accepted. Works on the levels that are read
// in every period, so it does not depend on kernel or library. Pure, real-time safe; time is an argument.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/gpio/gpio_lines.h"

namespace strainwave {

class Debounce {
 public:
  Debounce() = default;
  /// Time for which a level must be steady, by role; 0: accepted at once.
  explicit Debounce(const std::array<std::int64_t, kLineRoles>& steady_ns) noexcept : steady_ns_(steady_ns) {}

  /// Takes the levels of one period, bits by role, and returns the accepted levels. The first levels are accepted at once.
  std::uint32_t step(std::uint32_t active, std::int64_t now_ns) noexcept {
    if (!started_) believed_ = active;
    started_ = true;
    const std::uint32_t differing = active ^ believed_;
    for (std::size_t i = 0; i < kLineRoles; ++i) {
      const std::uint32_t role = 1U << i;
      if ((differing & ~differed_ & role) != 0) since_ns_[i] = now_ns;
      if ((differing & role) != 0 && now_ns - since_ns_[i] >= steady_ns_[i]) believed_ ^= role;
    }
    differed_ = active ^ believed_;
    return believed_;
  }

 private:
  std::array<std::int64_t, kLineRoles> steady_ns_{};
  std::array<std::int64_t, kLineRoles> since_ns_{};  ///< when a level that is not accepted yet was first read
  std::uint32_t believed_ = 0;
  std::uint32_t differed_ = 0;  ///< levels that were not accepted in the last period
  bool started_ = false;
};

}  // namespace strainwave
