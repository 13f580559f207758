// SPDX-License-Identifier: BSD-3-Clause
// Edges of GPIO lines of one chip, in order and with proof that none is missing. The class uses the kernel's
// GPIO uAPI v2 directly (linux/gpio.h). The API v1, the only one of libgpiod 1.6, has one queue of 16 events
// per line, no order between lines, and silent losses. read() and levels() are one system call each, never
// block and are real-time safe. Source: the kernel's include/uapi/linux/gpio.h.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "drivers/gpio/gpio_lines.h"

namespace strainwave {

struct Edge {
  std::int64_t time_ns = 0;    ///< CLOCK_MONOTONIC, taken by the interrupt
  std::uint32_t sequence = 0;  ///< over all lines of the request: 1, 2, ...
  std::uint32_t line = 0;      ///< index of the line in the constructor's list
  bool active = false;         ///< level after the edge
};

/// With kBoth the kernel reads the level shortly after the interrupt, so a very short pulse shows as two
/// edges to the same level. Pulses of which only the start counts need kActive.
enum class EdgeKind { kBoth, kActive };

class EdgeEvents {
 public:
  static constexpr std::size_t kReadAtOnce = 64;
  static constexpr std::uint32_t kKernelBuffer =
      1024;  ///< events that the kernel keeps; it drops older ones and counts them

  /// Requests the lines, which must be on one chip with the same settings. Throws InputError.
  EdgeEvents(std::span<const LineOptions> lines, EdgeKind kind, const std::string& consumer,
             const std::string& where);

  /// For poll().
  int descriptor() const noexcept { return fd_.get(); }
  /// Reads the edges so far, at most `edges.size()` or kReadAtOnce; -1 when the kernel refuses.
  int read(std::span<Edge> edges) noexcept;
  /// Bit i: line i is active now. Returns false when the kernel refuses.
  bool levels(std::uint32_t& active) noexcept;

 private:
  std::vector<std::uint32_t> offsets_;
  UniqueFd fd_;
};

}  // namespace strainwave
