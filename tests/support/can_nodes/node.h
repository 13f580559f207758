// SPDX-License-Identifier: BSD-3-Clause
// Interface of a simulated node to its program and to the tests: frames and time in, frames and a record out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tests/support/can_nodes/frame.h"

namespace strainwave::can_nodes {

/// A node's outputs: frames on the bus, lines in its record.
class NodeOutput {
 public:
  virtual ~NodeOutput() = default;
  virtual void send(const Frame& frame) = 0;
  virtual void note(const std::string& line) = 0;
};

/// A node's inputs: time and frames. Times are of CLOCK_MONOTONIC.
class Node {
 public:
  virtual ~Node() = default;
  virtual void power_on(std::int64_t now_us) = 0;
  virtual void receive(const Frame& frame, std::int64_t now_us) = 0;
  virtual void advance(std::int64_t now_us) = 0;
  virtual std::int64_t next_deadline_us() const = 0;
  virtual std::string command(std::string_view line, std::int64_t now_us) = 0;
};

}  // namespace strainwave::can_nodes
