// SPDX-License-Identifier: BSD-3-Clause
// The common part of the simulated nodes' programs: a node on a CAN interface. Commands come from standard
// input and a Unix datagram socket. The record goes to standard output, one line per event:
//   <microseconds of CLOCK_REALTIME, as utime in the messages> <event>
#pragma once

#include <string>

#include "tests/support/can_nodes/can_port.h"
#include "tests/support/can_nodes/node.h"

namespace strainwave::can_nodes {

/// Sends frames to the bus and writes lines to standard output.
class BusAndRecord final : public NodeOutput {
 public:
  explicit BusAndRecord(CanPort& port) : port_(port) {}
  void send(const Frame& frame) override;
  void note(const std::string& line) override;

 private:
  CanPort& port_;
  bool told_of_loss_ = false;
};

/// Runs until SIGTERM, SIGINT, or the command "quit". `control_path` is that of the Unix socket; empty: none.
/// Returns the exit status. Throws std::system_error if the socket cannot be made.
int run_node(Node& node, CanPort& port, BusAndRecord& record, const std::string& control_path);

}  // namespace strainwave::can_nodes
