// SPDX-License-Identifier: BSD-3-Clause
// What ends a program that a user watches: a signal, or any key where standard input is a terminal. Not real-time.
#pragma once

#include <sys/types.h>
#include <termios.h>

#include <optional>

#include "daemon/end_signals.h"

namespace strainwave {

class Interruption {
 public:
  /// Make it before any thread starts, as EndSignals. A terminal gives each key at once until the end. Throws std::system_error.
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Waits for at most so long; what came, in words, or null. A constant text.
  const char* wait(int timeout_ms) noexcept;
  bool has_terminal() const noexcept { return before_.has_value(); }

 private:
  EndSignals signals_;
  ::pid_t parent_;                 ///< that began this program
  std::optional<termios> before_;  ///< of the terminal; nothing: standard input is none
};

}  // namespace strainwave
