// SPDX-License-Identifier: BSD-3-Clause
// What ends a program that a user watches: a signal, or any key where standard input is a terminal. Not real-time.
#pragma once

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

 private:
  EndSignals signals_;
  std::optional<termios> before_;  ///< of the terminal; nothing: standard input is none
};

}  // namespace strainwave
