// SPDX-License-Identifier: BSD-3-Clause
// Keeps a gateway running: starts it and waits for it, restarts it when it has ended, and ends it when it hangs. Logs the datagrams
// that the gateway drops. Not real-time.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "daemon/config/config.h"
#include "daemon/gateway/gateway_process.h"
#include "daemon/gateway/gateway_pulse.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/log.h"

namespace strainwave {

class GatewayGuard {
 public:
  /// `inbound` is the memory that the gateway writes into; it must outlive this object.
  GatewayGuard(const DaemonConfig& config, GatewayProcess::Descriptors descriptors,
               const InboundMemory& inbound);

  /// Starts the gateway and waits until it is ready, which requires the network. Returns false as soon as `wanted` does. Throws
  /// std::runtime_error when the gateway ends or hangs.
  bool start(const std::function<bool()>& wanted);
  /// Call it every turn of the supervisor. Restarts a gateway that has ended if it is `wanted`, and ends one that hangs.
  void watch(bool wanted, std::int64_t now_ns);

 private:
  void restart(std::int64_t now_ns);
  void end_hung(std::int64_t now_ns);
  void log_dropped_datagrams(std::int64_t now_ns);
  void log_foreign_states();
  void log_deafness();

  std::string prefix_;
  std::string user_;  ///< user that the gateway runs as, as text for the log
  GatewayProcess process_;
  const InboundMemory& inbound_;
  LogLimiter dropped_log_;
  std::uint64_t dropped_seen_ = 0;
  std::uint64_t foreign_states_seen_ = 0;
  std::uint64_t deaf_seen_ = 0;
  GatewayPulse pulse_;
};

}  // namespace strainwave
