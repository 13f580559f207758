// SPDX-License-Identifier: BSD-3-Clause
// The gateway as the core sees it: a process that may die at any time and is started again, more slowly while it
// keeps dying, but always within a second: stops come through it. Either a child of the core's, or, through a socket of
// the service manager's, a service with a user of its own (daemon/gateway/gateway_activation.h). A connection between the
// two ends with either of them. Not real-time.
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
inline constexpr int kGatewayCoreFd = 6;  ///< hangs up when the core ends, or wants the gateway to
inline constexpr unsigned int kGatewayFirstFreeFd = 7;
inline constexpr int kGatewayExitNoLcm = 69;
/// And this one when what it publishes does not come back: the group has to be joined anew.
inline constexpr int kGatewayExitDeaf = 70;

class GatewayProcess {
 public:
  struct Descriptors {
    int outbound;
    int inbound;
    int wake;  ///< WakePipe::gateway_end()
  };
  /// Opens `program` and keeps it: after an upgrade of the package, the running core goes on with the gateway it knows.
  /// `service_socket`: where the service manager starts gateways; empty: they are children.
  GatewayProcess(std::string program, Descriptors descriptors, std::string service_socket = {});
  /// Ends the child.
  ~GatewayProcess();
  GatewayProcess(const GatewayProcess&) = delete;
  GatewayProcess& operator=(const GatewayProcess&) = delete;

  /// Starts it. Throws std::system_error when the program cannot be run at all; start_due() then waits as
  /// after an end.
  void start(std::int64_t now_ns);
  /// Ends it at once: it hangs. take_end() will tell. A service of another user is asked to end, and the service manager
  /// ends it when it does not (WatchdogSec).
  void kill() noexcept;
  /// How it ended ("exit status 69", "signal 9"; of a service the service manager's log knows), once, when it has;
  /// start_due() then says when to start it again.
  std::optional<std::string> take_end(std::int64_t now_ns);
  bool running() const noexcept { return static_cast<bool>(connection_); }
  std::int64_t started_ns() const noexcept { return started_ns_; }
  bool start_due(std::int64_t now_ns) const noexcept { return !running() && now_ns >= not_before_ns_; }
  int last_exit_status() const noexcept { return last_exit_status_; }
  /// Of a child.
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
  pid_t pid_ = -1;  ///< of a child
  int last_exit_status_ = 0;
  std::int64_t started_ns_ = 0;
  std::int64_t not_before_ns_ = 0;
  std::int64_t backoff_ns_;
};

/// The gateway's program: beside this executable, or where packages put it.
std::string find_gateway_program();

}  // namespace strainwave
