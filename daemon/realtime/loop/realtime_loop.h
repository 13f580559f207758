// SPDX-License-Identifier: BSD-3-Clause
// The loop: one real-time thread that runs every joint once a period.
//
// Constructing and starting it is not real-time; run() between its first and last line is: no allocation, lock, log,
// exception or file access. It stops by bringing every joint to rest, never by leaving one driven.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/loop/histogram.h"
#include "daemon/realtime/loop/loop_parts.h"
#include "daemon/realtime/loop/overrun_watch.h"
#include "daemon/realtime/loop/periodic_clock.h"
#include "daemon/realtime/path/path_follower.h"

namespace strainwave {

/// Written by the loop, readable by all threads.
struct LoopTotals {
  std::atomic<std::int64_t> cycles{0};  ///< executed
  std::atomic<std::int64_t> cycle{0};   ///< number of the present cycle, skipped ones included
  std::atomic<std::int64_t> overruns{0};
  std::atomic<std::int64_t> page_faults{0};
  Histogram wakeup_latency;
  Histogram execution_time;
  Histogram period_error;
  Histogram position_delay;  ///< of all joints whose drives measure it
};

class RealtimeLoop {
 public:
  /// Takes over the buses and drives. Writes records to `states`.
  RealtimeLoop(const LoopConfig& config, LoopParts parts, decltype(OutboundMemory::states)& states);
  /// Stops and joins.
  ~RealtimeLoop();
  RealtimeLoop(const RealtimeLoop&) = delete;
  RealtimeLoop& operator=(const RealtimeLoop&) = delete;

  /// Locks memory, starts the thread, waits for its set-up. Throws InputError when real time is refused and the
  /// configuration enforces it; otherwise real_time_refusal() says what was refused.
  void start();
  const std::string& real_time_refusal() const noexcept { return refusals_.real_time; }
  /// Why sleep states cannot be avoided, which would reduce latency but is not needed for real time; empty when granted.
  const std::string& sleep_state_refusal() const noexcept { return refusals_.sleep_states; }

  /// Brings every joint to rest, then ends the loop; then finished() is true.
  void request_stop() noexcept { signals_.stop_requested.store(true, std::memory_order_release); }
  bool finished() const noexcept { return signals_.finished.load(std::memory_order_acquire); }

  /// Call after finished(): closes the buses before the drives' supervision of the daemon times out.
  void close_buses();

  JointLoop& joint(std::size_t index) noexcept { return *joints_[index]; }
  /// Null when the joint is not recorded.
  FlightRecorder* recorder(std::size_t index) noexcept { return recorders_[index].get(); }
  std::size_t joint_count() const noexcept { return joints_.size(); }
  /// In the configuration's order.
  const std::vector<std::unique_ptr<Fieldbus>>& buses() const noexcept { return buses_; }
  ReplyQueue& replies() noexcept { return *replies_; }
  EventQueue& events() noexcept { return *events_; }
  const LoopTotals& statistics() const noexcept { return *statistics_; }

 private:
  /// Texts for the user; empty when granted.
  struct Refusals {
    std::string real_time;
    std::string sleep_states;
  };
  /// Flags between the threads.
  struct Signals {
    std::atomic<bool> set_up{false};
    std::atomic<bool> may_run{false};
    std::atomic<bool> stop_requested{false};
    std::atomic<bool> finished{false};
  };
  /// Used only by the loop's thread.
  struct Progress {
    std::int64_t previous_wake_ns = 0;
    std::int64_t next_publish_cycle = 0;
    std::int64_t stop_since_cycle = -1;
  };
  void thread_main();
  void run() noexcept;
  void account_wake(const PeriodicClock::Wake& wake, const CycleTime& time) noexcept;
  void bring_to_rest_when_asked(const CycleTime& time) noexcept;
  void account_positions() noexcept;
  void publish(const CycleTime& time) noexcept;
  void stop_drives() noexcept;

  LoopConfig config_;
  std::int64_t period_ns_;
  std::int64_t publish_every_;
  std::int64_t stop_deadline_periods_;
  decltype(OutboundMemory::states)& states_;
  std::unique_ptr<ReplyQueue> replies_;
  std::unique_ptr<EventQueue> events_;
  std::unique_ptr<LoopTotals> statistics_;
  std::vector<std::unique_ptr<FlightRecorder>> recorders_;
  std::vector<std::unique_ptr<Fieldbus>> buses_;  ///< the joints' drives refer to them
  std::vector<std::unique_ptr<JointLoop>> joints_;
  std::unique_ptr<PathFollower> paths_;
  std::thread thread_;
  Refusals refusals_;
  UniqueFd awake_;  ///< keeps the processors out of sleep states
  Signals signals_;
  Progress progress_;
  OverrunWatch overrun_watch_;
};

}  // namespace strainwave
