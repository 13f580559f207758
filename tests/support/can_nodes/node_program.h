// SPDX-License-Identifier: BSD-3-Clause
// What the programs of the simulated nodes share: a node on a CAN interface, commands from standard input and
// from a Unix datagram socket, and a record on standard output, one line per event:
//   <microseconds of CLOCK_REALTIME, as utime in the messages> <event>
#pragma once

#include <string>

#include "tests/support/can_nodes/can_port.h"
#include "tests/support/can_nodes/node.h"

namespace strainwave::can_nodes {

/// Frames onto the bus, lines onto standard output.
class BusAndRecord final : public NodeOutput {
 public:
  explicit BusAndRecord(CanPort& port) : port_(port) {}
  void send(const Frame& frame) override;
  void note(const std::string& line) override;

 private:
  CanPort& port_;
  bool told_of_loss_ = false;
};

/// Runs until SIGTERM, SIGINT, or the command "quit". `control_path`: of the Unix socket; empty: none.
/// Returns the exit status. Throws std::system_error when the socket cannot be made.
int run_node(Node& node, CanPort& port, BusAndRecord& record, const std::string& control_path);

}  // namespace strainwave::can_nodes
