// Digital inputs that must be steady for a while before they are believed, by role. The same for every kernel and library:
// the levels are read every period anyway. Pure, real-time safe; time is an argument.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/gpio/gpio_lines.h"

namespace strainwave {

class Debounce {
 public:
  Debounce() = default;
  /// 0 for a role: believed at once.
  explicit Debounce(const std::array<std::int64_t, kLineRoles>& steady_ns) noexcept : steady_ns_(steady_ns) {}

  /// One period's levels, bits by role; the levels that are believed. The first ones are believed as they are.
  std::uint32_t step(std::uint32_t active, std::int64_t now_ns) noexcept {
    if (!started_) believed_ = active;
    started_ = true;
    for (std::size_t i = 0; i < kLineRoles; ++i) {
      const std::uint32_t role = 1U << i;
      const bool differs = ((active ^ believed_) & role) != 0;
      if (differs && now_ns - agreed_ns_[i] < steady_ns_[i]) continue;
      if (differs) believed_ ^= role;
      agreed_ns_[i] = now_ns;
    }
    return believed_;
  }

 private:
  std::array<std::int64_t, kLineRoles> steady_ns_{};
  std::array<std::int64_t, kLineRoles> agreed_ns_{};
  std::uint32_t believed_ = 0;
  bool started_ = false;
};

}  // namespace strainwave
