// SPDX-License-Identifier: BSD-3-Clause
// The core's view of the gateway, a process that may die at any time. The core restarts it with a growing delay, but within a
// second, because stops come through it. The gateway is a child of the core, or a service with its own user that is started
// through a socket of the service manager (daemon/gateway/gateway_activation.h). The connection between the two closes when
// either ends. Not real-time.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "base/unique_fd.h"

namespace strainwave {

/// Descriptors the gateway inherits under these fixed numbers, and its exit statuses.
inline constexpr int kGatewayOutboundFd = 3;
inline constexpr int kGatewayInboundFd = 4;
inline constexpr int kGatewayWakeFd = 5;
inline constexpr int kGatewayCoreFd = 6;  ///< hangs up when the core ends, or asks the gateway to end
inline constexpr unsigned int kGatewayFirstFreeFd = 7;
inline constexpr int kGatewayExitNoLcm = 69;
/// Exit status when its own states do not come back: a new gateway must join the multicast group.
inline constexpr int kGatewayExitDeaf = 70;

class GatewayProcess {
 public:
  struct Descriptors {
    int outbound;
    int inbound;
    int wake;  ///< WakePipe::gateway_end()
  };
  /// Opens `program` and keeps it open: after an upgrade of the package, a running core keeps the gateway version that it knows.
  /// `service_socket`: connecting to it makes the service manager start a gateway; empty: gateways are children.
  GatewayProcess(std::string program, Descriptors descriptors, std::string service_socket = {});
  /// Ends the child.
  ~GatewayProcess();
  GatewayProcess(const GatewayProcess&) = delete;
  GatewayProcess& operator=(const GatewayProcess&) = delete;

  /// Starts the gateway. Throws std::system_error when the program cannot be run at all; start_due() then waits as
  /// after an end.
  void start(std::int64_t now_ns);
  /// Ends a gateway that hangs; take_end() then reports it. A child is killed at once. A service of another user is asked to
  /// end; if it does not, the service manager ends it (WatchdogSec).
  void kill() noexcept;
  /// Reports an end once ("exit status 69", "signal 9"; for a service, where its log is), otherwise nothing. start_due() then
  /// shows when to start it again.
  std::optional<std::string> take_end(std::int64_t now_ns);
  bool running() const noexcept { return static_cast<bool>(connection_); }
  std::int64_t started_ns() const noexcept { return started_ns_; }
  bool start_due(std::int64_t now_ns) const noexcept { return !running() && now_ns >= not_before_ns_; }
  int last_exit_status() const noexcept { return last_exit_status_; }
  /// The child's; -1: none.
  pid_t pid() const noexcept { return pid_; }

 private:
  void open_program();
  UniqueFd spawn();
  void connect_service();
  std::optional<std::string> end_of_child();
  std::optional<std::string> end_of_service();
  void back_off(std::int64_t now_ns) noexcept;

  std::string program_;
  std::string service_socket_;
  UniqueFd program_fd_;
  Descriptors descriptors_;
  UniqueFd connection_;
  pid_t pid_ = -1;  ///< of a child; -1: none
  int last_exit_status_ = 0;
  std::int64_t started_ns_ = 0;
  std::int64_t not_before_ns_ = 0;
  std::int64_t backoff_ns_;
};

/// The gateway's program: beside this executable, or where packages put it.
std::string find_gateway_program();

}  // namespace strainwave
