// SPDX-License-Identifier: BSD-3-Clause
// The part of CanBus that runs outside the loop.
#include <algorithm>
#include <chrono>
#include <utility>

#include "base/durations.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "drivers/can/can_bus.h"

namespace strainwave {

namespace {

constexpr std::chrono::milliseconds kServeEvery{20};
constexpr std::int64_t kTellEvery_ns = 10'000'000'000;

/// Sends our heartbeat during wait(), once the loop that sent it is `over`. Before that the drives must notice a loop that hangs.
class HeartbeatPort final : public CanPort {
 public:
  HeartbeatPort(CanPort& port, const CanBusConfig& config, const std::atomic<bool>& over)
      : port_(port), config_(config), over_(over) {}

  SendResult send(const CanFrame& frame) noexcept override { return port_.send(frame); }
  ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept override { return port_.receive(frames); }
  std::uint32_t overflows() const noexcept override { return port_.overflows(); }
  std::int64_t now_ns() override { return port_.now_ns(); }
  bool wait(std::int64_t timeout_ns) override {
    if (config_.heartbeat_period_s <= 0.0) return port_.wait(timeout_ns);
    const std::int64_t end_ns = now_ns() + timeout_ns;
    while (now_ns() < end_ns) {
      if (now_ns() >= due_ns_) {
        due_ns_ = now_ns() + nanoseconds(config_.heartbeat_period_s);
        if (over_.load(std::memory_order_acquire))
          (void)send(canopen::heartbeat_frame(config_.our_node_id, canopen::NmtState::kOperational));
      }
      if (port_.wait(std::min(end_ns, due_ns_) - now_ns())) return true;
    }
    return false;
  }

 private:
  CanPort& port_;
  const CanBusConfig& config_;
  const std::atomic<bool>& over_;
  std::int64_t due_ns_ = 0;
};

}  // namespace

class CanBus::Joint final : public Actuator {
 public:
  Joint(CanBus& bus, CanNode& node) : bus_(bus), node_(node) {}
  ActuatorReading read(std::int64_t now_ns) noexcept override { return node_.read(now_ns); }
  void write(const ActuatorCommand& command) noexcept override { node_.write(command); }
  void stop() noexcept override { node_.stop(); }
  void clear_fault() noexcept override {
    bus_.try_recover();
    node_.note_bus(bus_.trouble_);
    node_.clear_fault();
  }

 private:
  CanBus& bus_;
  CanNode& node_;
};

std::vector<FrameTraffic> CanBus::traffic_of(const CanBusConfig& config,
                                             const std::vector<std::unique_ptr<CanNode>>& nodes) {
  std::vector<FrameTraffic> traffic;
  if (config.sync != SyncProducer::kNone) traffic.push_back({"SYNC", 0, 1.0 / config.period_s});
  if (config.heartbeat_period_s > 0.0)
    traffic.push_back({"our heartbeat", 1, 1.0 / config.heartbeat_period_s});
  for (const auto& node : nodes)
    for (const FrameTraffic& frame : node->traffic()) traffic.push_back(frame);
  return traffic;
}

CanBus::CanBus(const CanBusConfig& config, std::vector<std::unique_ptr<CanNode>> nodes,
               const CanPortFactory& open)
    : config_(config), nodes_(std::move(nodes)) {
  const std::vector<FrameTraffic> traffic = traffic_of(config_, nodes_);
  require_bus_load(config_.interface_name, traffic, config_.bit_rate, config_.load_limit);
  say({bus_load_text(config_.interface_name, traffic, config_.bit_rate)});
  CanPortOptions setup;
  for (const auto& node : nodes_)
    for (const std::uint32_t id : node->setup_ids()) setup.receive_ids.push_back(id);
  setup_port_ = open(setup);
  set_up_nodes(open);
  open_loop_port(open);
  if (!config_.background_thread) return;
  background_ = std::thread([this] {
    while (!ending_.load(std::memory_order_acquire)) {
      serve();
      std::this_thread::sleep_for(kServeEvery);
    }
  });
}

CanBus::~CanBus() {
  close();
}

void CanBus::close() {
  if (std::exchange(closed_, true)) return;
  ending_.store(true, std::memory_order_release);
  for (const auto& node : nodes_) node->end_operation(*port_);
  if (background_.joinable()) background_.join();
  // Drives that answer slowly must receive our heartbeat until they have been told that it ends.
  HeartbeatPort port(*setup_port_, config_, ending_);
  for (const auto& node : nodes_) node->shut_down(port);
}

// Sets up all nodes, so that one run reports every problem.
void CanBus::set_up_nodes(const CanPortFactory& open) {
  std::string failures;
  const auto attempt = [&](const auto& action) {
    try {
      action();
    } catch (const InputError& error) {
      failures += (failures.empty() ? "" : "\n") + std::string(error.what());
    }
  };
  for (const auto& node : nodes_) attempt([&] { say(node->set_up(*setup_port_)); });
  if (failures.empty()) {
    // Verification has its own port: in the one for set-up, frames for the loop would pile up later.
    CanPortOptions options;
    for (const auto& node : nodes_)
      for (const std::uint32_t id : node->receive_ids()) options.receive_ids.push_back(id);
    // Own frames come back so that verification knows when our SYNC was on the bus.
    options.own_frames = config_.sync == SyncProducer::kDaemon;
    if (options.own_frames) options.receive_ids.push_back(canopen::cob_id(canopen::CobId::kSync));
    const std::unique_ptr<CanPort> port = open(options);
    for (const auto& node : nodes_) attempt([&] { say(node->verify(*port)); });
  }
  if (failures.empty()) return;
  for (const auto& node : nodes_) {
    node->end_operation(*setup_port_);
    node->shut_down(*setup_port_);
  }
  throw InputError(failures);
}

void CanBus::open_loop_port(const CanPortFactory& open) {
  CanPortOptions options;
  options.error_frames = options.own_frames = options.urgent = true;
  owner_.fill(kNobody);
  std::vector<std::uint32_t> ours;
  if (config_.sync == SyncProducer::kDaemon) ours.push_back(canopen::cob_id(canopen::CobId::kSync));
  if (config_.heartbeat_period_s > 0.0) ours.push_back(our_heartbeat_id());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (const std::uint32_t id : nodes_[i]->receive_ids()) {
      owner_[id] = static_cast<std::int16_t>(i);
      options.receive_ids.push_back(id);
    }
    for (const std::uint32_t id : nodes_[i]->transmit_ids()) ours.push_back(id);
  }
  if (config_.sync == SyncProducer::kOther) {
    const std::uint32_t sync = canopen::cob_id(canopen::CobId::kSync);
    owner_[sync] = kOthersSync;
    options.receive_ids.push_back(sync);
  }
  for (const std::uint32_t id : ours) {
    owner_[id] = kOurs;
    options.receive_ids.push_back(id);
  }
  port_ = open(options);
}

std::unique_ptr<Actuator> CanBus::make_actuator(std::size_t slot) {
  return std::make_unique<Joint>(*this, *nodes_.at(slot));
}

void CanBus::say(const std::vector<std::string>& lines) {
  const std::lock_guard lock(messages_mutex_);
  messages_.insert(messages_.end(), lines.begin(), lines.end());
}

std::vector<std::string> CanBus::take_messages() {
  const std::lock_guard lock(messages_mutex_);
  return std::exchange(messages_, {});
}

void CanBus::serve() {
  // close() may come while this thread waits for a drive.
  HeartbeatPort port(*setup_port_, config_, ending_);
  for (const auto& node : nodes_) {
    if (ending_.load(std::memory_order_acquire)) return;
    const std::vector<std::string> lines = node->serve(port);
    if (!lines.empty()) say(lines);
  }
  tell_losses();
}

// Reports at intervals losses that are no fault yet.
void CanBus::tell_losses() {
  const std::int64_t dropped = counters_.frames_dropped.load(std::memory_order_relaxed);
  const std::int64_t lost = counters_.frames_lost.load(std::memory_order_relaxed);
  const std::int64_t errors = counters_.error_frames.load(std::memory_order_relaxed);
  const std::int64_t now_ns = setup_port_->now_ns();
  if (dropped + lost + errors == losses_told_ || now_ns - losses_told_ns_ < kTellEvery_ns) return;
  losses_told_ = dropped + lost + errors;
  losses_told_ns_ = now_ns;
  say({config_.interface_name + ": since the start " + counted(dropped, "frame") + " not sent, " +
       std::to_string(lost) + " lost on the way in, " + counted(errors, "error frame")});
}

}  // namespace strainwave
