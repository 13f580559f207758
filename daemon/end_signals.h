// SPDX-License-Identifier: BSD-3-Clause
// Receives the signals that end the daemon in order, and the signal that a child process has ended. Not real-time.
#pragma once

#include <optional>

#include "base/unique_fd.h"

namespace strainwave {

class EndSignals {
 public:
  /// Create it before any thread starts, so that these signals arrive here and nowhere else. Throws std::system_error.
  EndSignals();

  /// Becomes readable when a signal has arrived, or a child has ended.
  int descriptor() const noexcept { return descriptor_.get(); }
  /// Takes all signals that have arrived. Returns the first that asks for the end, if there is one.
  std::optional<int> take() noexcept;

 private:
  UniqueFd descriptor_;
};

}  // namespace strainwave
