// SPDX-License-Identifier: BSD-3-Clause
// strainwave-telemetry as a child process, and somebody who connects to it byte by byte.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/unique_fd.h"

namespace strainwave::testing {

class RunningTelemetry {
 public:
  /// On a free port, with further `options`.
  explicit RunningTelemetry(const std::vector<std::string>& options = {},
                            const std::string& address = "127.0.0.1");
  /// Ends it by SIGTERM.
  ~RunningTelemetry();
  RunningTelemetry(const RunningTelemetry&) = delete;
  RunningTelemetry& operator=(const RunningTelemetry&) = delete;

  std::uint16_t port() const noexcept { return port_; }
  bool running() const;
  /// Memory in use (resident), in kilobytes.
  long memory_kB() const;
  /// The page /metrics; empty when it does not answer.
  std::string metrics() const;
  /// One sample of it, or -1.
  double metric(const std::string& sample) const;

 private:
  pid_t pid_ = -1;
  UniqueFd output_;
  std::uint16_t port_ = 0;
};

/// A TCP connection to `port` of this machine. Reads wait five seconds at most.
class RawClient {
 public:
  /// `receive_buffer_bytes`: of the system, for a client that shall fill it soon; 0: as usual.
  explicit RawClient(std::uint16_t port, int receive_buffer_bytes = 0);

  /// False: the other side has closed.
  bool send(const std::string& bytes) const;
  /// What comes until the other side closes, or nothing comes for five seconds.
  std::string read_all() const;
  /// What comes until `end` has come.
  std::string read_until(const std::string& end) const;
  /// Whether the other side closes within `seconds`; what comes is thrown away.
  bool is_closed_within(double seconds) const;

  /// Asks to become a viewer, with further `headers` of a line each, and reads the answer's header; false: it was refused.
  bool become_viewer(const std::string& headers = "Host: localhost\r\n") const;
  /// A text of the WebSocket protocol (RFC 6455), masked with zeros.
  bool send_text(const std::string& text) const;

 private:
  UniqueFd socket_;
};

/// The frame's header for `bytes` of the opcode (1: text), from a client.
std::string frame_header(std::uint64_t bytes, unsigned int opcode = 1);

}  // namespace strainwave::testing
