// The gateway as the core sees it: a child process that may die at any time and is started again, more slowly
// while it keeps dying, but always within a second: stops come through it. Not real-time.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace strainwave {

/// Descriptors the gateway inherits under these fixed numbers, and its exit statuses.
inline constexpr int kGatewayOutboundFd = 3;
inline constexpr int kGatewayInboundFd = 4;
inline constexpr int kGatewayWakeFd = 5;
inline constexpr unsigned int kGatewayFirstFreeFd = 6;
inline constexpr int kGatewayExitNoLcm = 69;

class GatewayProcess {
 public:
  struct Descriptors {
    int outbound;
    int inbound;
    int wake;  ///< WakePipe::gateway_end()
  };
  /// Opens `program` and keeps it: after an upgrade of the package, the running core goes on with the gateway it knows.
  GatewayProcess(std::string program, Descriptors descriptors);
  /// Ends the child.
  ~GatewayProcess();
  GatewayProcess(const GatewayProcess&) = delete;
  GatewayProcess& operator=(const GatewayProcess&) = delete;

  /// Starts it. Throws std::system_error when the program cannot be run at all; start_due() then waits as
  /// after an end.
  void start(std::int64_t now_ns);
  /// Ends it at once: it hangs. take_end() will tell.
  void kill() noexcept;
  /// How it ended ("exit status 69", "signal 9"), once, when it has; start_due() then says when to start it
  /// again.
  std::optional<std::string> take_end(std::int64_t now_ns);
  bool running() const noexcept { return pid_ > 0; }
  std::int64_t started_ns() const noexcept { return started_ns_; }
  bool start_due(std::int64_t now_ns) const noexcept { return pid_ <= 0 && now_ns >= not_before_ns_; }
  int last_exit_status() const noexcept { return last_exit_status_; }
  pid_t pid() const noexcept { return pid_; }

 private:
  void open_program();
  void back_off(std::int64_t now_ns) noexcept;

  std::string program_;
  int program_fd_ = -1;
  Descriptors descriptors_;
  pid_t pid_ = -1;
  int last_exit_status_ = 0;
  std::int64_t started_ns_ = 0;
  std::int64_t not_before_ns_ = 0;
  std::int64_t backoff_ns_;
};

/// The gateway's program: beside this executable, or where packages put it.
std::string find_gateway_program();

}  // namespace strainwave
