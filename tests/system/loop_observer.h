// SPDX-License-Identifier: BSD-3-Clause
// Observes the loop and its gateway in every cycle through the daemon's shared memory, because LCM is under attack.
#pragma once

#include <fcntl.h>
#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "daemon/gateway/shared_memory.h"
#include "tests/support/daemon_fixture.h"

namespace strainwave::testing {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The daemon's memory file with this name, mapped for reading.
inline MemoryFile open_memory(pid_t daemon, const std::string& name, std::size_t size) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(daemon) + "/fd")) {
    std::error_code error;
    if (std::filesystem::read_symlink(entry.path(), error).string().find(name) == std::string::npos) continue;
    return MemoryFile::open(::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC), size, false);
  }
  throw std::runtime_error("the daemon has no memory file " + name);
}

/// Reads every cycle's record from the daemon's shared memory, as its gateway does.
class LoopObserver {
 public:
  explicit LoopObserver(pid_t daemon)
      : file_(open_memory(daemon, "strainwave-outbound", sizeof(OutboundMemory))) {
    cursor_ = memory().states.written();
  }

  /// Behaviour of the loop since the last call.
  struct Summary {
    std::int64_t cycles = 0;           ///< seen
    std::int64_t cycles_missed = 0;    ///< missing numbers: overruns
    std::int64_t records_dropped = 0;  ///< because this observer was too slow
    std::int64_t faults = 0;
    double worst_error_rad = 0.0;
    double error_squares = 0.0;
    double worst_torque_step_Nm = 0.0;
    bool left_tracking = false;

    double rms_error_rad() const {
      return std::sqrt(error_squares / static_cast<double>(std::max<std::int64_t>(1, cycles)));
    }
  };
  void observe(Summary& summary) {
    StateRecord record{};
    std::uint64_t dropped = 0;
    while (memory().states.read(cursor_, record, dropped)) {
      const state_v1& state = record.state;
      const double error_rad = std::abs(state.setpoint_position_rad - state.joint_position_rad);
      ++summary.cycles;
      summary.faults = std::max(summary.faults, state.faults_total);
      summary.worst_error_rad = std::max(summary.worst_error_rad, error_rad);
      summary.error_squares += error_rad * error_rad;
      summary.left_tracking =
          summary.left_tracking || state.mode != static_cast<std::int32_t>(Mode::kTracking);
      if (last_cycle_ >= 0) {
        summary.cycles_missed += state.cycle - last_cycle_ - 1;
        summary.worst_torque_step_Nm =
            std::max(summary.worst_torque_step_Nm, std::abs(state.torque_commanded_Nm - last_torque_Nm_));
      }
      last_cycle_ = state.cycle;
      last_torque_Nm_ = state.torque_commanded_Nm;
    }
    summary.records_dropped += static_cast<std::int64_t>(dropped);
  }
  std::int64_t last_cycle() const { return last_cycle_; }

 private:
  const OutboundMemory& memory() const { return *static_cast<const OutboundMemory*>(file_.address()); }

  MemoryFile file_;
  std::uint64_t cursor_ = 0;
  std::int64_t last_cycle_ = -1;
  double last_torque_Nm_ = 0.0;
};

/// Counts and times the gateway's absences. An absence ends when the next gateway works, not when it exists.
/// look() must be called often.
class GatewayWatch {
 public:
  explicit GatewayWatch(const DaemonProcess& daemon)
      : daemon_(daemon),
        file_(open_memory(daemon.pid(), "strainwave-inbound", sizeof(InboundMemory))),
        pid_(daemon.gateway_pid()) {}

  void look() {
    const pid_t now = daemon_.gateway_pid();
    if (now != pid_ && !away_) {
      away_ = true;
      gone_since_ = Clock::now();
      turns_ = turns();
    }
    pid_ = now;
    if (!away_ || turns() == turns_) return;
    away_ = false;
    ++restarts_;
    last_s_ = seconds_since(gone_since_);
    longest_s_ = std::max(longest_s_, last_s_);
  }
  int restarts() const { return restarts_; }
  double last_absence_s() const { return last_s_; }
  double longest_absence_s() const { return longest_s_; }

 private:
  std::uint64_t turns() const { return static_cast<const InboundMemory*>(file_.address())->turns.load(); }

  const DaemonProcess& daemon_;
  MemoryFile file_;
  pid_t pid_;
  bool away_ = false;
  std::uint64_t turns_ = 0;
  Clock::time_point gone_since_;
  int restarts_ = 0;
  double last_s_ = 0.0;
  double longest_s_ = 0.0;
};

}  // namespace strainwave::testing
