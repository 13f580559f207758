// SPDX-License-Identifier: BSD-3-Clause
// strainwave-telemetry as a child process, and a raw client of it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/unique_fd.h"

namespace strainwave::testing {

class RunningTelemetry {
 public:
  /// Starts the program on a free port, with further `options`.
  explicit RunningTelemetry(const std::vector<std::string>& options = {},
                            const std::string& address = "127.0.0.1");
  /// Ends the program with SIGTERM.
  ~RunningTelemetry();
  RunningTelemetry(const RunningTelemetry&) = delete;
  RunningTelemetry& operator=(const RunningTelemetry&) = delete;

  std::uint16_t port() const noexcept { return port_; }
  bool running() const;
  /// Resident memory in kilobytes.
  long memory_kB() const;
  /// Returns the page /metrics, or "" without an answer.
  std::string metrics() const;
  /// Returns the value of one sample of that page, or -1.
  double metric(const std::string& sample) const;

 private:
  pid_t pid_ = -1;
  UniqueFd output_;
  std::uint16_t port_ = 0;
};

/// A TCP connection to `port` of this machine. A read waits five seconds at most.
class RawClient {
 public:
  /// `receive_buffer_bytes`: size of the system's receive buffer, small to fill it soon; 0 for the default.
  explicit RawClient(std::uint16_t port, int receive_buffer_bytes = 0);

  /// Returns false if the other side has closed.
  bool send(const std::string& bytes) const;
  /// Reads until the other side closes or nothing comes for five seconds.
  std::string read_all() const;
  /// Reads until `end` has come.
  std::string read_until(const std::string& end) const;
  /// Returns whether the other side closes within `seconds`. Discards all input.
  bool is_closed_within(double seconds) const;

  /// Asks to become a viewer, with further `headers`, one a line. Reads the header of the answer; returns false if it is a refusal.
  bool become_viewer(const std::string& headers = "Host: localhost\r\n") const;
  /// Sends a text message of the WebSocket protocol (RFC 6455), masked with zeros.
  bool send_text(const std::string& text) const;

 private:
  UniqueFd socket_;
};

/// Returns a client's frame header for a payload of `bytes` and this opcode (1: text).
std::string frame_header(std::uint64_t bytes, unsigned int opcode = 1);

}  // namespace strainwave::testing
