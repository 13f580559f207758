// SPDX-License-Identifier: BSD-3-Clause
// Touch probe 1 of a CiA 402 drive: the drive latches its position at a rising edge of the encoder's index or a probe input. Each arming
// latches one pulse, so that a second pulse at the same position counts as well. Real-time safe. Source: CiA 402-2, 60B8h to 60BAh.
//
//   arm -> the drive reports enabled -> it latches: one pulse -> disarm -> it reports disabled -> arm
#pragma once

#include <cstdint>

namespace strainwave::cia402 {

/// Trigger of the touch probe.
enum class ProbeSource : std::uint8_t { kNone, kIndex, kInput };

class TouchProbe {
 public:
  explicit TouchProbe(ProbeSource source = ProbeSource::kNone) noexcept : source_(source) {}

  /// Called after set-up: earlier latches are discarded.
  void restart() noexcept { state_ = State::kDisarming; }

  /// Returns 60B8h for this period.
  std::uint16_t function() const noexcept {
    if (source_ == ProbeSource::kNone || state_ == State::kDisarming) return 0;
    return kEnable | kRisingEdge | (source_ == ProbeSource::kIndex ? kByIndex : std::uint16_t{0});
  }

  /// Takes 60B9h. Returns true for a new pulse; 60BAh is then its position.
  bool see(std::uint16_t status) noexcept {
    const bool enabled = (status & kEnabled) != 0;
    const bool latched = enabled && (status & kLatched) != 0;
    const bool pulse = state_ == State::kArmed && latched;
    if (state_ == State::kDisarming && !enabled)
      state_ = State::kArmed;
    else if (pulse)
      state_ = State::kDisarming;
    return pulse;
  }

 private:
  enum class State : std::uint8_t { kDisarming, kArmed };
  // 60B8h; bit 1 stays 0: latch only the first event.
  static constexpr std::uint16_t kEnable = 1U << 0U;
  static constexpr std::uint16_t kByIndex = 1U << 2U;
  static constexpr std::uint16_t kRisingEdge = 1U << 4U;
  // 60B9h
  static constexpr std::uint16_t kEnabled = 1U << 0U;
  static constexpr std::uint16_t kLatched = 1U << 1U;

  ProbeSource source_;
  State state_ = State::kDisarming;
};

}  // namespace strainwave::cia402
