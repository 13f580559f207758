// SPDX-License-Identifier: BSD-3-Clause
// A non-blocking raw CAN socket for the simulated nodes' programs, with a controller's acceptance filters.
// While the interface is down, frames are lost, as with a cut cable.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "tests/support/can_nodes/frame.h"

namespace strainwave::can_nodes {

/// Accepts frames whose identifier equals `id` in the bits of `mask`.
struct AcceptanceFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0x7FF;
};

class CanPort {
 public:
  /// Throws std::system_error if `interface` does not exist or the kernel has no CAN.
  CanPort(const std::string& interface, const std::vector<AcceptanceFilter>& filters);

  int descriptor() const { return descriptor_.get(); }
  /// The next frame with an 11-bit identifier, if one is waiting.
  std::optional<Frame> receive();
  /// Returns false if the bus did not accept the frame.
  bool send(const Frame& frame);

 private:
  UniqueFd descriptor_;
};

}  // namespace strainwave::can_nodes
