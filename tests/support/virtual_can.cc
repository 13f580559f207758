// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/virtual_can.h"

#include <algorithm>
#include <utility>

namespace strainwave::testing {

class VirtualCan::Port final : public CanPort {
 public:
  Port(VirtualCan& bus, const CanPortOptions& options)
      : bus_(bus), options_(options), ids_(options.receive_ids.begin(), options.receive_ids.end()) {
    bus_.ports_.push_back(this);
  }
  ~Port() override { bus_.forget_port(*this); }

  SendResult send(const CanFrame& frame) noexcept override { return bus_.send_from_port(*this, frame); }
  ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept override {
    for (; !late_.empty() && late_.front().first <= bus_.now_ns_; late_.pop_front())
      queue_.push_back(late_.front().second);
    ReceiveResult result;
    while (result.count < frames.size() && !queue_.empty()) {
      frames[result.count++] = queue_.front();
      queue_.pop_front();
    }
    if (result.count < frames.size()) result.link = std::exchange(link_, CanLink::kUp);
    return result;
  }
  std::uint32_t overflows() const noexcept override { return overflows_; }
  bool wait(std::int64_t timeout_ns) override {
    const std::int64_t end_ns = bus_.now_ns_ + std::max<std::int64_t>(timeout_ns, 0);
    while (queue_.empty() && bus_.now_ns_ < end_ns) bus_.run_to(std::min(end_ns, bus_.next_deadline_ns()));
    return !queue_.empty();
  }
  std::int64_t now_ns() override { return bus_.now_ns_; }

  void hear(const CanFrame& frame, bool own) {
    if (!ids_.contains(frame.id) || (own && !options_.own_frames)) return;
    if (own && bus_.echo_is_lost(frame.id)) return;
    ReceivedFrame received;
    received.frame = frame;
    received.kind = own ? ReceivedFrame::Kind::kOwn : ReceivedFrame::Kind::kData;
    received.kernel_time_ns = bus_.now_ns_;
    if (own && bus_.echo_delay_ns_ > 0)
      late_.emplace_back(bus_.now_ns_ + bus_.echo_delay_ns_, received);
    else
      queue_.push_back(received);
  }
  void hear_trouble(CanTrouble trouble) {
    if (!options_.error_frames) return;
    ReceivedFrame received;
    received.kind = ReceivedFrame::Kind::kTrouble;
    received.troubles = static_cast<std::uint32_t>(trouble);
    queue_.push_back(received);
  }
  void lose_link(CanLink link) { link_ = link; }
  void lose_frames(std::uint32_t count) {
    overflows_ += count;
    queue_.clear();
  }

 private:
  VirtualCan& bus_;
  CanPortOptions options_;
  std::set<std::uint32_t> ids_;
  std::deque<ReceivedFrame> queue_;
  std::deque<std::pair<std::int64_t, ReceivedFrame>> late_;  ///< with the time of their echo
  CanLink link_ = CanLink::kUp;
  std::uint32_t overflows_ = 0;
};

void VirtualCan::Output::send(const can_nodes::Frame& frame) {
  CanFrame ours;
  ours.id = frame.id;
  ours.size = frame.length;
  std::copy(frame.bytes().begin(), frame.bytes().end(), ours.bytes.begin());
  bus_.put_on_bus(ours, nullptr, true);
}

CanPortFactory VirtualCan::factory() {
  return [this](const CanPortOptions& options) { return std::make_unique<Port>(*this, options); };
}

SendResult VirtualCan::send_from_port(Port& port, const CanFrame& frame) {
  if (down_) return SendResult::kLinkDown;
  if (hold_) {
    if (static_cast<int>(held_.size()) >= queue_room_) return SendResult::kQueueFull;
    held_.emplace_back(&port, frame);
    return SendResult::kSent;
  }
  put_on_bus(frame, &port, false);
  return SendResult::kSent;
}

void VirtualCan::put_on_bus(const CanFrame& frame, Port* sender, bool from_node) {
  if (down_) return;
  trace_.push_back({now_ns_, frame, from_node});
  for (Port* port : ports_) port->hear(frame, port == sender);
  if (from_node) return;
  can_nodes::Frame theirs(frame.id, frame.payload());
  theirs.remote = frame.remote;
  for (const auto& node : nodes_) node->receive(theirs, now_ns_ / 1000);
}

bool VirtualCan::echo_is_lost(std::uint32_t id) {
  if (lost_echo_id_ == id) {
    lost_echo_id_.reset();
    return true;
  }
  if (lost_echoes_ == 0) return false;
  --lost_echoes_;
  return true;
}

void VirtualCan::forget_port(Port& port) {
  std::erase(ports_, &port);
  std::erase_if(held_, [&](const auto& entry) { return entry.first == &port; });
}

std::int64_t VirtualCan::next_deadline_ns() const {
  std::int64_t next_us = INT64_MAX / 1000;
  for (const auto& node : nodes_) next_us = std::min(next_us, node->next_deadline_us());
  return std::max(next_us * 1000, now_ns_);
}

void VirtualCan::advance_nodes() {
  for (const auto& node : nodes_) node->advance(now_ns_ / 1000);
}

void VirtualCan::run_to(std::int64_t time_ns) {
  while (next_deadline_ns() < time_ns) {
    now_ns_ = next_deadline_ns();
    advance_nodes();
  }
  now_ns_ = std::max(now_ns_, time_ns);
  advance_nodes();
}

void VirtualCan::send_as_stranger(const CanFrame& frame) {
  put_on_bus(frame, nullptr, false);
}

void VirtualCan::tell_trouble(CanTrouble trouble) {
  for (Port* port : ports_) port->hear_trouble(trouble);
}

void VirtualCan::set_down() {
  down_ = true;
  held_.clear();
  for (Port* port : ports_) port->lose_link(CanLink::kDown);
}

void VirtualCan::set_gone() {
  set_down();
  for (Port* port : ports_) port->lose_link(CanLink::kGone);
}

void VirtualCan::hold(bool held) {
  hold_ = held;
  if (held) return;
  for (const auto& [port, frame] : std::exchange(held_, {})) put_on_bus(frame, port, false);
}

void VirtualCan::lose_frames(std::uint32_t count) {
  for (Port* port : ports_) port->lose_frames(count);
}

}  // namespace strainwave::testing
