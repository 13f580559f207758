// SPDX-License-Identifier: BSD-3-Clause
// Removes the torque of a drive that process data no longer reach. It was taken out of its network state, or
// its positions are missing, and its last order may still act. Real-time safe; time is an argument.
//
//   idle --begin--> disabling: controlword 0 by SDO, three times 10 ms apart (a pre-operational drive accepts it)
//     --> resetting: NMT reset of the node (a stopped drive accepts it)
//     --> watching: a heartbeat without a boot-up message repeats the reset once (the drive may have been unreachable);
//         a further heartbeat shows that it has not obeyed
//     --> withdrawn: our heartbeat ends; only the drive's supervision of it (1016h, 6007h) is left. This also stops
//         the other drives of this bus, because they receive the same heartbeat.
// A boot-up message ends the sequence at every step: a drive that has restarted has no torque.
#pragma once

#include <cstdint>

#include "drivers/can/can_frame.h"

namespace strainwave::cia402 {

class LastResort {
 public:
  explicit LastResort(std::uint8_t node_id) noexcept : node_id_(node_id) {}

  /// Does nothing while the sequence runs or after its end.
  void begin(std::int64_t now_ns) noexcept;
  /// Takes any heartbeat except boot-up messages.
  void hear(std::int64_t now_ns) noexcept;
  void hear_boot_up() noexcept {
    if (step_ != Step::kIdle) step_ = Step::kObeyed;
  }
  /// The drive has been set up again.
  void end() noexcept { step_ = Step::kIdle; }

  bool under_way() const noexcept { return step_ != Step::kIdle; }
  bool withdraws_heartbeat() const noexcept { return step_ == Step::kWithdrawn; }

  /// Returns whether frame() must be sent in this period.
  bool due(std::int64_t now_ns) const noexcept {
    return (step_ == Step::kDisabling || step_ == Step::kResetting) && now_ns >= next_ns_;
  }
  CanFrame frame() const noexcept;
  /// Records that frame() has been sent.
  void sent(std::int64_t now_ns) noexcept;

 private:
  enum class Step : std::uint8_t { kIdle, kDisabling, kResetting, kWatching, kWithdrawn, kObeyed };

  std::uint8_t node_id_;
  Step step_ = Step::kIdle;
  int disables_sent_ = 0;
  int resets_sent_ = 0;
  std::int64_t next_ns_ = 0;
  std::int64_t reset_ns_ = 0;
};

}  // namespace strainwave::cia402
