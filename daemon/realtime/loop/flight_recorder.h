// SPDX-License-Identifier: BSD-3-Clause
// Keeps the last seconds of one joint at full rate, in memory allocated at the start. The real-time thread
// writes plain copies, and stops shortly after a fault. Another thread then reads the record and releases
// the memory. write() is real-time safe.
//
//   recording -> (a fault appears: samples_after_fault more) -> frozen -> release() -> recording
// While frozen nothing is recorded; the samples lost meanwhile are counted.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strainwave {

/// One joint in one cycle; fields as in state_v1.
struct FlightSample {
  std::int64_t time_ns = 0;  ///< CLOCK_MONOTONIC
  std::int64_t cycle = 0;
  std::int64_t table_id = 0;
  double setpoint_position_rad = 0.0;
  double setpoint_velocity_rad_s = 0.0;
  double target_position_rad = 0.0;
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;
  double torque_commanded_Nm = 0.0;
  double torque_applied_Nm = 0.0;
  double torque_feedback_Nm = 0.0;
  double torque_feedforward_Nm = 0.0;
  double temperature_used_C = 0.0;
  double temperature_measured_C = 0.0;
  double zero_velocity_weight = 0.0;
  std::uint32_t drive_error = 0;  ///< as in state_v1
  std::uint32_t notices = 0;      ///< as in state_v1
  std::uint8_t mode = 0;
  std::uint8_t fault = 0;
  std::uint8_t temperature_status = 0;
  std::uint8_t drive_state = 0;  ///< DriveState
  std::uint8_t reading_fresh = 0;
};

class FlightRecorder {
 public:
  /// Keeps `samples` >= 2, of which `samples_after_fault` < samples follow the fault. Allocates and touches
  /// the memory.
  FlightRecorder(std::size_t samples, std::size_t samples_after_fault)
      : samples_(samples), samples_after_fault_(samples_after_fault) {}

  /// Real-time thread, every cycle.
  void write(const FlightSample& sample) noexcept {
    const Phase phase = phase_.load(std::memory_order_acquire);
    const bool fault_appears = sample.fault != 0 && previous_fault_ == 0;
    previous_fault_ = sample.fault;
    if (phase == Phase::kFrozen) {
      ++lost_;
      return;
    }
    if (phase == Phase::kReleased) restart();
    samples_[next_] = sample;
    if (fault_appears && until_frozen_ < 0) {
      until_frozen_ = static_cast<std::int64_t>(samples_after_fault_);
      fault_position_ = written_;
    }
    next_ = next_ + 1 == samples_.size() ? 0 : next_ + 1;
    ++written_;
    if (until_frozen_ >= 0 && until_frozen_-- == 0) phase_.store(Phase::kFrozen, std::memory_order_release);
  }

  // The other thread.
  bool frozen() const noexcept { return phase_.load(std::memory_order_acquire) == Phase::kFrozen; }
  // Only while frozen:
  std::size_t size() const noexcept { return written_ < samples_.size() ? written_ : samples_.size(); }
  /// Oldest first.
  const FlightSample& sample(std::size_t index) const noexcept {
    return samples_[(next_ + samples_.size() - size() + index) % samples_.size()];
  }
  /// Index of the sample in which the fault appeared.
  std::size_t fault_index() const noexcept { return fault_position_ - (written_ - size()); }
  /// Samples lost before this record, because the previous record was still frozen.
  std::int64_t lost() const noexcept { return lost_before_; }
  void release() noexcept { phase_.store(Phase::kReleased, std::memory_order_release); }

 private:
  enum class Phase : int { kRecording, kFrozen, kReleased };

  void restart() noexcept {
    next_ = 0;
    written_ = 0;
    until_frozen_ = -1;
    lost_before_ = lost_;
    lost_ = 0;
    phase_.store(Phase::kRecording, std::memory_order_release);
  }

  std::vector<FlightSample> samples_;
  std::size_t samples_after_fault_;
  std::size_t next_ = 0;
  std::size_t written_ = 0;
  std::size_t fault_position_ = 0;
  std::int64_t until_frozen_ = -1;
  std::int64_t lost_ = 0;
  std::int64_t lost_before_ = 0;
  std::uint8_t previous_fault_ = 0;
  std::atomic<Phase> phase_{Phase::kRecording};
};

}  // namespace strainwave
