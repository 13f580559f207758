// SPDX-License-Identifier: BSD-3-Clause
// One CAN bus with its drives behind the seam fieldbus.h. It starts them, and then, each period:
//
//   begin_cycle: take what has arrived, give it to the nodes     (joints read, compute, write)
//   end_cycle:   every node's frames, then one SYNC, then our heartbeat when it is due
//
// Nothing stale is ever queued: every frame that we send comes back once it is on the bus, and while frames
// older than a period have not come back nothing more is sent, only counted. So after a bus was dead the drives
// hear at most two periods' old orders, and their heartbeat supervision has disabled them by then. Trouble of
// the bus is latched and told to every node, and leaves only by a joint's clear_fault(). Until then the nodes of joints
// in use order nothing but to stop, and that goes out as soon as the interface takes it.
//
// Our heartbeat comes from end_cycle() alone: when the loop ends or hangs, the drives notice. It also ends when a node
// withdraws it from a drive that obeys nothing else.
//
// Real time: begin_cycle() and end_cycle() are real-time safe; everything else is not. A background thread of
// ordinary priority serves the nodes over a socket of its own; it shares only what the nodes keep lock-free.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drivers/can/can_detail.h"
#include "drivers/can/can_node.h"
#include "drivers/can/can_port.h"
#include "drivers/can/canopen/canopen.h"
#include "drivers/fieldbus.h"

namespace strainwave {

/// Who tells the drives when to act.
enum class SyncProducer {
  kNone,    ///< the protocol has no SYNC
  kDaemon,  ///< we, at the end of each period
  kOther,   ///< a drive, or another device
};

struct CanBusConfig {
  std::string interface_name;  ///< "can0"
  std::uint32_t bit_rate = 1'000'000;
  double load_limit = 0.85;  ///< of the computed bus load
  double period_s = 0.001;
  SyncProducer sync = SyncProducer::kDaemon;
  std::uint8_t our_node_id = 127;   ///< in our heartbeat
  double heartbeat_period_s = 0.0;  ///< of ours; 0: none
  int stuck_periods = 3;            ///< periods that frames may wait for the bus before it is a fault
  bool background_thread = true;    ///< false: only tests serve, by serve()
};

class CanBus final : public Fieldbus, private CanTransmitter {
 public:
  /// Counts since the start; the loop writes, anybody reads.
  struct Counters {
    std::atomic<std::int64_t> frames_sent{0};
    std::atomic<std::int64_t> frames_dropped{0};  ///< not sent: the bus had not taken what was sent before
    std::atomic<std::int64_t> frames_lost{0};     ///< lost by the kernel before we took them
    std::atomic<std::int64_t> error_frames{0};    ///< of the controller, of all kinds
  };

  /// Checks the load, sets every node up, verifies it, and opens the loop's port last, so that nothing waits
  /// in it. Throws InputError that names every node that failed.
  CanBus(const CanBusConfig& config, std::vector<std::unique_ptr<CanNode>> nodes, const CanPortFactory& open);
  /// Closes.
  ~CanBus() override;

  std::unique_ptr<Actuator> make_actuator(std::size_t slot) override;
  /// Lines for take_messages().
  void say(const std::vector<std::string>& lines);
  std::vector<std::string> take_messages() override;
  void close() override;
  void begin_cycle(std::int64_t now_ns) noexcept override;
  void end_cycle() noexcept override;

  /// One turn of the background thread.
  void serve();
  const Counters& counters() const noexcept { return counters_; }
  /// All that is sent on this bus.
  static std::vector<FrameTraffic> traffic_of(const CanBusConfig& config,
                                              const std::vector<std::unique_ptr<CanNode>>& nodes);

 private:
  static constexpr std::size_t kBatch = 64;
  /// A bus cannot carry more in 10 ms; what is beyond waits for the next period.
  static constexpr std::size_t kMaxFramesPerCycle = 256;
  static constexpr std::int16_t kNobody = -1;
  static constexpr std::int16_t kOurs = -2;
  static constexpr std::int16_t kOthersSync = -3;

  /// Forwards to a node; on clear_fault() the bus recovers first.
  class Joint;

  void set_up_nodes(const CanPortFactory& open);
  void open_loop_port(const CanPortFactory& open);
  void tell_losses();

  bool send(const CanFrame& frame) noexcept override;
  void take(const ReceivedFrame& received) noexcept;
  void take_own(const ReceivedFrame& received) noexcept;
  void note_sync(std::int64_t kernel_time_ns) noexcept;
  void take_link(CanLink link) noexcept;
  void take_troubles(std::uint32_t troubles) noexcept;
  void account_outstanding(bool emptied) noexcept;
  bool heartbeat_withdrawn() const noexcept;
  void send_heartbeat() noexcept;
  std::uint32_t our_heartbeat_id() const noexcept {
    return canopen::cob_id(canopen::CobId::kHeartbeat, config_.our_node_id);
  }
  void latch(ActuatorFault fault, CanDetail detail, std::uint32_t value = 0) noexcept;
  /// On an operator's order: ends the latched trouble if the bus works again and holds none of our frames.
  void try_recover() noexcept;

  CanBusConfig config_;
  std::vector<std::unique_ptr<CanNode>> nodes_;
  std::unique_ptr<CanPort> setup_port_;
  std::unique_ptr<CanPort> port_;
  std::array<std::int16_t, kMaxCanId + 1> owner_{};  ///< of each identifier: a node, kNobody or kOurs
  std::array<ReceivedFrame, kBatch> batch_{};

  std::int64_t now_ns_ = 0;
  std::int64_t heartbeat_due_ns_ = 0;
  NodeFault trouble_;  ///< latched
  bool link_gone_ = false;
  bool bus_off_ = false;          ///< until the interface was down or the controller restarted
  std::int64_t outstanding_ = 0;  ///< frames sent that have not come back, heartbeats not counted
  std::int64_t sent_last_period_ = 0;
  bool heartbeat_waits_ = false;           ///< sent and not come back
  std::int64_t sent_since_heartbeat_ = 0;  ///< of what `outstanding_` counts, after the last heartbeat
  int held_back_periods_ = 0;
  int flooded_periods_ = 0;
  std::uint32_t overflows_seen_ = 0;
  bool held_back_ = false;
  bool dropped_ = false;     ///< in this period
  int dropped_periods_ = 0;  ///< in a row, because the queue was full
  Counters counters_;

  std::int64_t losses_told_ = 0;  ///< background thread
  std::int64_t losses_told_ns_ = 0;
  std::mutex messages_mutex_;
  std::vector<std::string> messages_;
  std::atomic<bool> ending_{false};
  std::thread background_;
  bool closed_ = false;
};

}  // namespace strainwave
