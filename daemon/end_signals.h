// SPDX-License-Identifier: BSD-3-Clause
// The signals that end the daemon in order, and the end of a child. Not real-time.
#pragma once

#include <optional>

#include "base/unique_fd.h"

namespace strainwave {

class EndSignals {
 public:
  /// Make it before any thread starts: from here on all of them arrive here and nowhere else. Throws std::system_error.
  EndSignals();

  /// Readable when a signal is there, or a child has ended.
  int descriptor() const noexcept { return descriptor_.get(); }
  /// Takes all that have come; the first that asks for the end, if one does.
  std::optional<int> take() noexcept;

 private:
  UniqueFd descriptor_;
};

}  // namespace strainwave
