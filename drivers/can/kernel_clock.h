// SPDX-License-Identifier: BSD-3-Clause
// Converts the kernel's time of a frame to the loop's time, from the echoes of a frame that we send in every period. Real-time safe.
//
//   offset = kernel's time of the echo - loop's time of the cycle that sent it, smoothed
//
// The offset includes the delay from the start of the cycle to the end of the frame on the bus, which is the same in every period.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

namespace strainwave {

class KernelClock {
 public:
  explicit KernelClock(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}

  void restart() noexcept { *this = KernelClock(period_ns_); }
  /// Our frame goes out in the cycle that began at `cycle_ns`.
  void sent(std::int64_t cycle_ns) noexcept { sent_ns_ = cycle_ns; }
  /// The frame has gone out at this kernel time; 0: unknown.
  void echoed(std::int64_t kernel_time_ns) noexcept {
    if (kernel_time_ns == 0 || sent_ns_ == 0) return;
    const std::int64_t offset_ns = kernel_time_ns - sent_ns_;
    // A late echo belongs to another cycle. When several in a row disagree, the kernel's clock was set.
    const bool agrees = known_ && std::llabs(offset_ns - offset_ns_) <= period_ns_ / kPlaceShare;
    strangers_ = agrees ? 0 : strangers_ + 1;
    if (agrees)
      offset_ns_ += (offset_ns - offset_ns_) / kSmoothing;
    else if (!known_ || strangers_ >= kAgreeing)
      offset_ns_ = offset_ns;
    known_ = true;
  }
  /// Returns nothing before the first echo, and for a frame without a time.
  std::optional<std::int64_t> loop_time_ns(std::int64_t kernel_time_ns) const noexcept {
    if (!known_ || kernel_time_ns == 0) return std::nullopt;
    return kernel_time_ns - offset_ns_;
  }

 private:
  static constexpr std::int64_t kPlaceShare = 4;  ///< allowed jitter of an echo: period / kPlaceShare
  static constexpr std::int64_t kSmoothing = 16;
  static constexpr int kAgreeing = 10;

  std::int64_t period_ns_;
  std::int64_t sent_ns_ = 0;
  std::int64_t offset_ns_ = 0;
  int strangers_ = 0;  ///< consecutive echoes that did not agree
  bool known_ = false;
};

}  // namespace strainwave
