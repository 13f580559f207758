// SPDX-License-Identifier: BSD-3-Clause
// A simulated node on its own bus in virtual time. The bench keeps what the node sends and records, and time
// passes event by event, as in the node's program.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/can_nodes/node.h"

namespace strainwave::can_nodes {

class KeptOutput final : public NodeOutput {
 public:
  void send(const Frame& frame) override { frames.push_back(frame); }
  void note(const std::string& line) override { lines.push_back(line); }

  std::vector<Frame> frames;
  std::vector<std::string> lines;
};

template <typename NodeType, typename Config>
class NodeBench {
 public:
  explicit NodeBench(const Config& config) : node(config, output) { node.power_on(0); }

  /// Lets time pass, and calls the node at each of its deadlines.
  void wait_us(std::int64_t duration_us) {
    const std::int64_t end_us = now_us + duration_us;
    while (node.next_deadline_us() <= end_us) {
      now_us = std::max(now_us, node.next_deadline_us());
      node.advance(now_us);
    }
    now_us = end_us;
  }
  /// Sends one frame and returns the node's answers.
  std::vector<Frame> exchange(const Frame& frame) {
    output.frames.clear();
    node.receive(frame, now_us);
    return std::exchange(output.frames, {});
  }
  std::string command(std::string_view line) { return node.command(line, now_us); }
  /// Whether a recorded line begins with `beginning`.
  bool recorded(std::string_view beginning) const {
    return std::any_of(output.lines.begin(), output.lines.end(),
                       [&](const std::string& line) { return line.starts_with(beginning); });
  }
  bool sent(const Frame& frame) const {
    return std::find(output.frames.begin(), output.frames.end(), frame) != output.frames.end();
  }

  KeptOutput output;
  NodeType node;
  std::int64_t now_us = 0;
};

}  // namespace strainwave::can_nodes
