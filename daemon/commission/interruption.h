// SPDX-License-Identifier: BSD-3-Clause
// Detects what ends a watched program: a signal, its parent's end, or any key if standard input is a terminal. Not real-time.
#pragma once

#include <sys/types.h>
#include <termios.h>

#include <optional>

#include "daemon/end_signals.h"

namespace strainwave {

class Interruption {
 public:
  /// Construct it before any thread starts, like EndSignals. Until its end a terminal delivers each key at once. Throws std::system_error.
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Waits at most `timeout_ms`. Returns a constant text about the interruption, or null.
  const char* wait(int timeout_ms) noexcept;
  bool has_terminal() const noexcept { return before_.has_value(); }

 private:
  EndSignals signals_;
  ::pid_t parent_;                 ///< started this program
  std::optional<termios> before_;  ///< settings of the terminal; none: standard input is no terminal
};

}  // namespace strainwave
