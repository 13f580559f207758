// SPDX-License-Identifier: BSD-3-Clause
// A raw CAN socket for the simulated nodes' programs: non-blocking, with a controller's acceptance filters. An interface that
// is down loses frames, as a cable does, and carries them again when it is up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "tests/support/can_nodes/frame.h"

namespace strainwave::can_nodes {

/// Lets frames through whose identifier is `id` in the bits of `mask`.
struct AcceptanceFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0x7FF;
};

class CanPort {
 public:
  /// Throws std::system_error when `interface` is not there or the kernel has no CAN.
  CanPort(const std::string& interface, const std::vector<AcceptanceFilter>& filters);

  int descriptor() const { return descriptor_.get(); }
  /// The next frame with an 11-bit identifier, if one waits.
  std::optional<Frame> receive();
  /// False when the bus did not take it.
  bool send(const Frame& frame);

 private:
  UniqueFd descriptor_;
};

}  // namespace strainwave::can_nodes
