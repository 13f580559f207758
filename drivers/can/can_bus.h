// SPDX-License-Identifier: BSD-3-Clause
// One CAN bus with its drives, as a Fieldbus. It starts the drives and then does the following in each period:
//
//   begin_cycle: take what has arrived, give it to the nodes     (joints read, compute, write)
//   end_cycle:   every node's frames, then one SYNC, then our heartbeat when it is due
//
// The bus never queues old orders. Every frame that we send comes back once it is on the bus. While frames older than a
// period have not come back, the bus only counts further frames and does not send them. So after an interruption the
// drives receive at most two periods of old orders, and their heartbeat supervision has disabled them by then. The bus
// latches its fault, reports it to every node, and ends it only on a joint's clear_fault(). Until then the nodes of
// joints in use order only a stop, which goes out as soon as the interface accepts it.
//
// Only end_cycle() sends our heartbeat: when the loop ends or hangs, the drives notice. The heartbeat also
// ends when a node withdraws it because its drive obeys nothing else.
//
// Only begin_cycle() and end_cycle() are real-time safe. A background thread of normal priority serves the
// nodes over its own socket. It shares only lock-free data of the nodes with the loop.
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

/// The device that sends SYNC.
enum class SyncProducer {
  kNone,    ///< the protocol has no SYNC
  kDaemon,  ///< this daemon, at the end of each period
  kOther,   ///< a drive, or another device
};

struct CanBusConfig {
  std::string interface_name;  ///< "can0"
  std::uint32_t bit_rate = 1'000'000;
  double load_limit = 0.85;  ///< highest computed bus load allowed
  double period_s = 0.001;
  SyncProducer sync = SyncProducer::kDaemon;
  std::uint8_t our_node_id = 127;   ///< node id in our heartbeat
  double heartbeat_period_s = 0.0;  ///< of our heartbeat; 0: none
  int stuck_periods = 3;            ///< a fault when frames wait for the bus this many periods
  bool background_thread = true;    ///< false: tests call serve() themselves
};

class CanBus final : public Fieldbus, private CanTransmitter {
 public:
  /// Counts since the start; the loop writes, any thread reads.
  struct Counters {
    std::atomic<std::int64_t> frames_sent{0};
    std::atomic<std::int64_t> frames_dropped{0};  ///< not sent: the bus had not taken earlier frames
    std::atomic<std::int64_t> frames_lost{0};     ///< lost by the kernel before we read them
    std::atomic<std::int64_t> error_frames{0};    ///< all kinds of the controller's error frames
  };

  /// Checks the load, sets up and verifies every node, and opens the loop's port last, so that no frames wait
  /// in it. Throws InputError with every node that failed.
  CanBus(const CanBusConfig& config, std::vector<std::unique_ptr<CanNode>> nodes, const CanPortFactory& open);
  /// Calls close().
  ~CanBus() override;

  std::unique_ptr<Actuator> make_actuator(std::size_t slot) override;
  /// Adds lines for take_messages().
  void say(const std::vector<std::string>& lines);
  std::vector<std::string> take_messages() override;
  void close() override;
  void begin_cycle(std::int64_t now_ns) noexcept override;
  void end_cycle() noexcept override;

  /// One run of the background thread.
  void serve();
  const Counters& counters() const noexcept { return counters_; }
  /// Returns all frames on this bus with their rates.
  static std::vector<FrameTraffic> traffic_of(const CanBusConfig& config,
                                              const std::vector<std::unique_ptr<CanNode>>& nodes);

 private:
  static constexpr std::size_t kBatch = 64;
  /// A bus carries no more frames in 10 ms; further ones wait for the next period.
  static constexpr std::size_t kMaxFramesPerCycle = 256;
  static constexpr std::int16_t kNobody = -1;
  static constexpr std::int16_t kOurs = -2;
  static constexpr std::int16_t kOthersSync = -3;

  /// Forwards to a node; its clear_fault() first recovers the bus.
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
  /// Called on an operator's order. Ends the latched fault if the bus works again and holds none of our frames.
  void try_recover() noexcept;

  CanBusConfig config_;
  std::vector<std::unique_ptr<CanNode>> nodes_;
  std::unique_ptr<CanPort> setup_port_;
  std::unique_ptr<CanPort> port_;
  std::array<std::int16_t, kMaxCanId + 1> owner_{};  ///< of each identifier: a node, or a constant above
  std::array<ReceivedFrame, kBatch> batch_{};

  std::int64_t now_ns_ = 0;
  std::int64_t heartbeat_due_ns_ = 0;
  NodeFault trouble_;  ///< latched fault of the bus
  bool link_gone_ = false;
  bool bus_off_ = false;          ///< until the interface is down or the controller restarts
  std::int64_t outstanding_ = 0;  ///< frames sent that have not come back, without heartbeats
  std::int64_t sent_last_period_ = 0;
  bool heartbeat_waits_ = false;           ///< sent, but has not come back
  std::int64_t sent_since_heartbeat_ = 0;  ///< frames that `outstanding_` counts, since the last heartbeat
  int held_back_periods_ = 0;
  int flooded_periods_ = 0;
  std::uint32_t overflows_seen_ = 0;
  bool held_back_ = false;
  bool dropped_ = false;     ///< frames dropped in this period
  int dropped_periods_ = 0;  ///< consecutive periods with a full queue
  Counters counters_;

  std::int64_t losses_told_ = 0;  ///< owned by the background thread
  std::int64_t losses_told_ns_ = 0;
  std::mutex messages_mutex_;
  std::vector<std::string> messages_;
  std::atomic<bool> ending_{false};
  std::thread background_;
  bool closed_ = false;
};

}  // namespace strainwave
