// SPDX-License-Identifier: BSD-3-Clause
// Logging of the supervisor and the start-up: spdlog to stderr, which is the journal under systemd. The real-time thread must
// not log. Logging never waits for a reader. Control characters in a line become question marks.
#pragma once

#include <cstdint>

namespace strainwave {

/// Sets the format of the lines. Call it once, before the first line.
void start_logging();

/// Lets at most `burst` lines through per `window`, and counts the lines that it suppresses.
class LogLimiter {
 public:
  LogLimiter(int burst, std::int64_t window_ns) : burst_(burst), window_ns_(window_ns) {}
  /// Whether to log now. Sets `suppressed` to the number of lines suppressed in the window before, else to 0.
  bool allow(std::int64_t now_ns, std::int64_t& suppressed) {
    suppressed = 0;
    if (now_ns - window_start_ns_ >= window_ns_) {
      suppressed = suppressed_;
      suppressed_ = 0;
      used_ = 0;
      window_start_ns_ = now_ns;
    }
    if (used_ < burst_) {
      ++used_;
      return true;
    }
    ++suppressed_;
    return false;
  }

 private:
  int burst_;
  std::int64_t window_ns_;
  std::int64_t window_start_ns_ = 0;
  int used_ = 0;
  std::int64_t suppressed_ = 0;
};

}  // namespace strainwave
