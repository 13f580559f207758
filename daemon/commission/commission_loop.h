// SPDX-License-Identifier: BSD-3-Clause
// Runs a commissioning with the drives of a configuration. Simulated joints run as fast as the computer allows. Real joints have a
// real-time thread, which also keeps the buses alive between the steps. The other joints stay disabled.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "commission/commissioning.h"
#include "daemon/commission/interruption.h"
#include "daemon/realtime/loop/loop_parts.h"

namespace strainwave {

class CommissionLoop {
 public:
  /// `joint`: index in `parts`. Throws InputError where real time is refused and `config` enforces it.
  CommissionLoop(const LoopConfig& config, LoopParts parts, std::size_t joint, bool simulated);
  /// Disables the drives and closes the buses.
  ~CommissionLoop();
  CommissionLoop(const CommissionLoop&) = delete;
  CommissionLoop& operator=(const CommissionLoop&) = delete;

  /// Position of the joint. Throws NotAchieved if the drive sends no position within 5 s, or has a fault.
  double first_position_rad();
  /// Runs until the step of `commissioning` ends its motion. An interruption aborts the step; returns its text, or null without one.
  const char* run(Commissioning& commissioning, Interruption& interruption);

  /// Messages of the buses since the last call.
  std::vector<std::string> take_messages();
  /// Why real time was refused; empty: it was granted, or is not needed.
  const std::string& real_time_refusal() const { return refusal_; }

 private:
  void thread_main();
  void period(std::int64_t now_ns, std::int64_t skipped) noexcept;
  void simulate_period();

  LoopConfig config_;
  LoopParts parts_;
  std::size_t joint_;
  bool simulated_;
  std::int64_t simulated_ns_ = 0;
  std::string refusal_;
  std::atomic<Commissioning*> moved_{nullptr};              ///< null: all drives are disabled
  std::atomic<const char*> interruption_{nullptr};          ///< to be passed to moved_
  std::atomic<bool> positioned_{false};                     ///< a position has arrived
  std::atomic<double> position_rad_{0.0};                   ///< the last position
  std::atomic<ActuatorFault> fault_{ActuatorFault::kNone};  ///< of the last reading
  std::atomic<bool> set_up_{false};
  std::atomic<bool> may_run_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace strainwave
