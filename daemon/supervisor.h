// SPDX-License-Identifier: BSD-3-Clause
// The core's ordinary thread: everything around the loop that may block, allocate or log. It starts the gateway, admits its messages,
// passes orders to the joints and answers them. It also publishes slow messages, logs, reports to systemd, and ends the daemon in order.
// Not real-time.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "daemon/admission/admission.h"
#include "daemon/admission/answers.h"
#include "daemon/admission/pending_orders.h"
#include "daemon/config/config.h"
#include "daemon/end_signals.h"
#include "daemon/friction_keeper.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/gateway/wake_pipe.h"
#include "daemon/gateway_guard.h"
#include "daemon/instance_lock.h"
#include "daemon/log.h"
#include "daemon/realtime/loop/realtime_loop.h"
#include "daemon/service_notifier.h"

namespace strainwave {

class Supervisor {
 public:
  /// Takes the locks, and makes drivers and shared memory. Throws InputError or std::system_error.
  explicit Supervisor(const DaemonConfig& config);
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Runs until a signal of EndSignals, such as SIGTERM or SIGINT, has brought every joint to rest.
  void run();

 private:
  void fill_shared_memory();
  void load_initial_tables();
  void turn(std::int64_t now_ns);
  void wait(std::int64_t wait_ms);
  void take_messages(std::int64_t now_ns);
  bool take_message(const InboundLane& lane, std::uint64_t& taken, std::atomic<std::uint64_t>& told,
                    std::int64_t now_ns);
  void publish_challenge();
  void publish_owners(std::int64_t now_ns);
  void take_events();
  void log_buses();
  void take_states(std::int64_t now_ns);
  void publish_timing(std::int64_t now_ns);
  void tell_systemd(std::int64_t now_ns);
  void log_refusal(const Verdict& verdict, std::int64_t now_ns);

  DaemonConfig config_;
  std::vector<InstanceLock> locks_;
  std::int64_t session_id_;
  MemoryFile outbound_file_;
  MemoryFile inbound_file_;
  OutboundMemory& outbound_;
  InboundMemory& inbound_;
  WakePipe wake_;
  EndSignals signals_;
  RealtimeLoop loop_;
  FlightRecordWriter flight_records_;
  FrictionKeeper friction_;
  Admission admission_;
  Answers answers_;
  PendingOrders orders_;
  GatewayGuard gateway_;
  std::vector<StateRecord> latest_;  ///< latest state of each joint
  LogLimiter refusal_log_;
  ServiceNotifier service_;
  std::unique_ptr<WireMessage> incoming_;
  std::uint64_t stops_taken_ = 0;
  std::uint64_t orders_taken_ = 0;
  std::uint64_t state_cursor_ = 0;
  std::int64_t temperature_due_ns_ = 0;
  std::int64_t timing_due_ns_ = 0;
  std::int64_t status_due_ns_ = 0;
  bool stopping_ = false;
};

}  // namespace strainwave
