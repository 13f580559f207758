// SPDX-License-Identifier: BSD-3-Clause
// A CAN bus in virtual time between simulated nodes and the drivers' ports. Nothing depends on the host's
// clock; virtual time passes while a port waits. The bus can be unplugged, go down, and withhold frames.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "drivers/can/can_port.h"
#include "tests/support/can_nodes/node.h"

namespace strainwave::testing {

class VirtualCan {
 public:
  /// One frame on the bus.
  struct Entry {
    std::int64_t time_ns;
    CanFrame frame;
    bool from_node;
  };

  /// Adds a node made by `make` that writes into output(), and switches it on.
  template <typename NodeType, typename Config>
  NodeType& add(const Config& config) {
    auto node = std::make_unique<NodeType>(config, output_);
    NodeType& reference = *node;
    nodes_.push_back(std::move(node));
    reference.power_on(now_ns_ / 1000);
    return reference;
  }
  CanPortFactory factory();
  /// Lets time pass to `time_ns`.
  void run_to(std::int64_t time_ns);
  std::int64_t now_ns() const { return now_ns_; }
  /// Sends a frame that comes from neither a node nor one of our ports.
  void send_as_stranger(const CanFrame& frame);
  /// Sends an error frame of the controller.
  void tell_trouble(CanTrouble trouble);
  void set_down();
  void set_gone();
  void set_up() { down_ = false; }
  /// While held, frames of ports wait and are not echoed, as on a bus without acknowledgement.
  void hold(bool held);
  /// Number of frames that still fit while held.
  void set_queue_room(int frames) { queue_room_ = frames; }
  /// Delays the echo of a port's own frames, as an adapter on USB does.
  void set_echo_delay(std::int64_t delay_ns) { echo_delay_ns_ = delay_ns; }
  /// The next `count` own frames are sent, but not echoed.
  void lose_echoes(int count) { lost_echoes_ = count; }
  /// The next own frame with this identifier is not echoed.
  void lose_echo_of(std::uint32_t id) { lost_echo_id_ = id; }
  /// Simulates that the kernel lost frames of every port.
  void lose_frames(std::uint32_t count);

  const std::vector<Entry>& trace() const { return trace_; }
  const std::vector<std::string>& notes() const { return output_.notes; }
  std::size_t held_frames() const { return held_.size(); }

 private:
  class Port;
  class Output final : public can_nodes::NodeOutput {
   public:
    explicit Output(VirtualCan& bus) : bus_(bus) {}
    void send(const can_nodes::Frame& frame) override;
    void note(const std::string& line) override { notes.push_back(line); }
    std::vector<std::string> notes;

   private:
    VirtualCan& bus_;
  };

  SendResult send_from_port(Port& port, const CanFrame& frame);
  void put_on_bus(const CanFrame& frame, Port* sender, bool from_node);
  void forget_port(Port& port);
  std::int64_t next_deadline_ns() const;
  void advance_nodes();

  std::int64_t now_ns_ = 1'000'000'000;
  Output output_{*this};
  std::vector<std::unique_ptr<can_nodes::Node>> nodes_;
  std::vector<Port*> ports_;
  std::deque<std::pair<Port*, CanFrame>> held_;
  std::vector<Entry> trace_;
  bool down_ = false;
  bool hold_ = false;
  int queue_room_ = 10;
  std::int64_t echo_delay_ns_ = 0;
  int lost_echoes_ = 0;
  std::optional<std::uint32_t> lost_echo_id_;

  bool echo_is_lost(std::uint32_t id);
};

}  // namespace strainwave::testing
