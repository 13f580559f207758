// SPDX-License-Identifier: BSD-3-Clause
// Takes the torque from a drive that process data no longer reaches: it was taken out of its network state, or its positions
// stay away, and what it was last ordered may act on. Real-time safe; time is an argument.
//
//   idle --begin--> disabling: controlword 0 by SDO, three times 10 ms apart (a drive that is pre-operational takes it)
//     --> resetting: NMT reset of the node (one that is stopped takes that)
//     --> watching: heard again without a boot-up message, it is reset once more (it may have been out of sight); heard after
//         that, it has obeyed neither
//     --> withdrawn: our heartbeat ends, and the drive's own supervision of us (1016h, 6007h) is what is left. It ends the
//         other drives of this bus as well, since they hear the same heartbeat.
// A boot-up message ends it at every step: a drive that has restarted has no torque.
#pragma once

#include <cstdint>

#include "drivers/can/can_frame.h"

namespace strainwave::cia402 {

class LastResort {
 public:
  explicit LastResort(std::uint8_t node_id) noexcept : node_id_(node_id) {}

  /// Does nothing while it is under way, or has reached its end.
  void begin(std::int64_t now_ns) noexcept;
  /// Any heartbeat, boot-up messages apart.
  void hear(std::int64_t now_ns) noexcept;
  void hear_boot_up() noexcept {
    if (step_ != Step::kIdle) step_ = Step::kObeyed;
  }
  /// The drive has been set up anew.
  void end() noexcept { step_ = Step::kIdle; }

  bool under_way() const noexcept { return step_ != Step::kIdle; }
  bool withdraws_heartbeat() const noexcept { return step_ == Step::kWithdrawn; }

  /// Whether frame() is to be sent in this period.
  bool due(std::int64_t now_ns) const noexcept {
    return (step_ == Step::kDisabling || step_ == Step::kResetting) && now_ns >= next_ns_;
  }
  CanFrame frame() const noexcept;
  /// frame() has been sent.
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
