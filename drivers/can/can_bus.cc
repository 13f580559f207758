// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_bus.h"

#include <algorithm>

#include "base/durations.h"

namespace strainwave {

namespace {

void add(std::atomic<std::int64_t>& counter, std::int64_t count = 1) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + count, std::memory_order_relaxed);
}

constexpr bool has(std::uint32_t troubles, CanTrouble trouble) noexcept {
  return (troubles & static_cast<std::uint32_t>(trouble)) != 0;
}

}  // namespace

void CanBus::begin_cycle(std::int64_t now_ns) noexcept {
  now_ns_ = now_ns;
  for (const auto& node : nodes_) node->begin_cycle(now_ns);
  bool emptied = false;
  for (std::size_t taken = 0; taken < kMaxFramesPerCycle && !emptied; taken += kBatch) {
    const ReceiveResult result = port_->receive(batch_);
    for (std::size_t i = 0; i < result.count; ++i) take(batch_[i]);
    take_link(result.link);
    emptied = result.count < batch_.size();
  }
  account_outstanding(emptied);
  for (const auto& node : nodes_) node->note_bus(trouble_);
}

void CanBus::take(const ReceivedFrame& received) noexcept {
  switch (received.kind) {
    case ReceivedFrame::Kind::kTrouble:
      return take_troubles(received.troubles);
    case ReceivedFrame::Kind::kOwn:
      return take_own(received);
    case ReceivedFrame::Kind::kData:
      break;
  }
  const std::int16_t owner = owner_[received.frame.id & kMaxCanId];
  if (owner >= 0)
    return nodes_[static_cast<std::size_t>(owner)]->receive(received.frame, received.kernel_time_ns);
  if (owner == kOthersSync) return note_sync(received.kernel_time_ns);
  // Two masters of one drive, or two SYNC producers: neither knows what the drive does.
  if (owner == kOurs) latch(ActuatorFault::kWriteRefused, CanDetail::kForeignSender, received.frame.id);
}

// The heartbeat has the lowest priority. A full period may delay it without harm, so a waiting heartbeat does not hold back other
// frames. The bus keeps the order of frames: those sent before a returned heartbeat have left, even without an echo.
void CanBus::take_own(const ReceivedFrame& received) noexcept {
  if (received.frame.id == canopen::sync_frame().id) note_sync(received.kernel_time_ns);
  for (const auto& node : nodes_) node->note_own(received.frame, received.kernel_time_ns);
  if (received.frame.id == our_heartbeat_id()) {
    heartbeat_waits_ = false;
    outstanding_ = std::min(outstanding_, sent_since_heartbeat_);
  } else {
    outstanding_ = std::max<std::int64_t>(outstanding_ - 1, 0);
  }
}

void CanBus::note_sync(std::int64_t kernel_time_ns) noexcept {
  for (const auto& node : nodes_) node->note_sync(kernel_time_ns);
}

void CanBus::take_link(CanLink link) noexcept {
  if (link == CanLink::kUp) return;
  link_gone_ = link_gone_ || link == CanLink::kGone;
  // An interface that goes down discards its queue, and its controller starts anew.
  outstanding_ = 0;
  heartbeat_waits_ = false;
  bus_off_ = false;
  latch(ActuatorFault::kConnectionLost, link_gone_ ? CanDetail::kInterfaceGone : CanDetail::kInterfaceDown);
}

void CanBus::take_troubles(std::uint32_t troubles) noexcept {
  add(counters_.error_frames);
  if (has(troubles, CanTrouble::kRestarted)) {
    // A restarted controller has discarded its frames without a report.
    bus_off_ = false;
    outstanding_ = 0;
    heartbeat_waits_ = false;
  }
  if (has(troubles, CanTrouble::kBusOff)) {
    bus_off_ = true;
    latch(ActuatorFault::kBusError, CanDetail::kBusOff);
  } else if (has(troubles, CanTrouble::kErrorPassive)) {
    latch(ActuatorFault::kBusError, CanDetail::kErrorPassive);
  }
}

void CanBus::account_outstanding(bool emptied) noexcept {
  const std::uint32_t overflows = port_->overflows();
  if (overflows != overflows_seen_) {
    add(counters_.frames_lost, static_cast<std::uint32_t>(overflows - overflows_seen_));
    overflows_seen_ = overflows;
    // The lost frames may include our own echoes, so the counts of waiting frames are unknown.
    if (emptied) {
      outstanding_ = 0;
      heartbeat_waits_ = false;
    }
  }
  // Frames that do not fit into one period are too old when they are used.
  flooded_periods_ = emptied ? 0 : flooded_periods_ + 1;
  if (flooded_periods_ >= config_.stuck_periods) latch(ActuatorFault::kBusError, CanDetail::kFlooded);
  // USB adapters report a sent frame up to a period late; older frames are still waiting.
  held_back_ = outstanding_ > sent_last_period_;
  sent_last_period_ = 0;
  held_back_periods_ = held_back_ ? held_back_periods_ + 1 : 0;
  if (held_back_periods_ >= config_.stuck_periods)
    latch(ActuatorFault::kConnectionLost, CanDetail::kFramesStuck);
}

void CanBus::latch(ActuatorFault fault, CanDetail detail, std::uint32_t value) noexcept {
  if (trouble_.fault == ActuatorFault::kNone) trouble_ = {fault, drive_error_of(detail, value)};
}

void CanBus::end_cycle() noexcept {
  dropped_ = false;
  for (const auto& node : nodes_) node->transmit(*this);
  if (config_.sync == SyncProducer::kDaemon) (void)send(canopen::sync_frame());
  // A heartbeat that seems to wait for its whole period while other frames came back was sent; only its echo is missing.
  const bool due = config_.heartbeat_period_s > 0.0 && now_ns_ >= heartbeat_due_ns_;
  if (due && !heartbeat_withdrawn() && (!heartbeat_waits_ || outstanding_ <= sent_last_period_))
    send_heartbeat();
  dropped_periods_ = dropped_ ? dropped_periods_ + 1 : 0;
  if (dropped_periods_ >= config_.stuck_periods) latch(ActuatorFault::kWriteRefused, CanDetail::kQueueFull);
}

bool CanBus::heartbeat_withdrawn() const noexcept {
  return std::any_of(nodes_.begin(), nodes_.end(),
                     [](const std::unique_ptr<CanNode>& node) { return node->withdraws_heartbeat(); });
}

void CanBus::send_heartbeat() noexcept {
  heartbeat_due_ns_ = now_ns_ + nanoseconds(config_.heartbeat_period_s);
  heartbeat_waits_ = send(canopen::heartbeat_frame(config_.our_node_id, canopen::NmtState::kOperational));
  if (heartbeat_waits_) sent_since_heartbeat_ = 0;
}

bool CanBus::send(const CanFrame& frame) noexcept {
  if (held_back_ || bus_off_) {
    add(counters_.frames_dropped);
    return false;
  }
  switch (port_->send(frame)) {
    case SendResult::kSent:
      // Frames that pass none of our filters do not come back.
      if (owner_[frame.id] == kOurs && frame.id != our_heartbeat_id() && !frame.remote) {
        ++outstanding_;
        ++sent_last_period_;
        ++sent_since_heartbeat_;
      }
      add(counters_.frames_sent);
      return true;
    case SendResult::kLinkDown:
      take_link(CanLink::kDown);
      break;
    case SendResult::kQueueFull:
      dropped_ = true;
      break;
  }
  add(counters_.frames_dropped);
  return false;
}

void CanBus::try_recover() noexcept {
  if (trouble_.fault == ActuatorFault::kNone || link_gone_ || bus_off_ || held_back_) return;
  // The first frame shows whether the link works; a heartbeat orders nothing.
  if (config_.heartbeat_period_s > 0.0) {
    send_heartbeat();
    if (!heartbeat_waits_) return;
  }
  trouble_ = {};
  held_back_periods_ = dropped_periods_ = flooded_periods_ = 0;
}

}  // namespace strainwave
