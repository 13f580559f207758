// A raw CAN socket for the simulated nodes' programs: non-blocking, every frame of the bus. An interface that
// is down loses frames, as a cable does, and carries them again when it is up.
#pragma once

#include <optional>
#include <string>

#include "tests/support/can_nodes/frame.h"

namespace strainwave::can_nodes {

class CanPort {
 public:
  /// Throws std::system_error when `interface` is not there or the kernel has no CAN.
  explicit CanPort(const std::string& interface);
  ~CanPort();
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;

  int descriptor() const { return descriptor_; }
  /// The next frame with an 11-bit identifier, if one waits.
  std::optional<Frame> receive();
  /// False when the bus did not take it.
  bool send(const Frame& frame);

 private:
  int descriptor_;
};

}  // namespace strainwave::can_nodes
