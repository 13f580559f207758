// SPDX-License-Identifier: BSD-3-Clause
// What a simulated node is to the program that runs it, and to the tests: frames and time in, frames and a
// record out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tests/support/can_nodes/frame.h"

namespace strainwave::can_nodes {

/// What a node does to the outside: frames onto the bus, lines into its record.
class NodeOutput {
 public:
  virtual ~NodeOutput() = default;
  virtual void send(const Frame& frame) = 0;
  virtual void note(const std::string& line) = 0;
};

/// What a node has to do with time and frames; times are of CLOCK_MONOTONIC.
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
