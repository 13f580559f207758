// SPDX-License-Identifier: BSD-3-Clause
// Runs a drive's node through periods that the fuzzer's bytes fill with frames, orders and calls. Checks that readings are finite, that the
// node sends only its own identifiers, and that it orders no torque after a fault.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "drivers/can/can_node.h"
#include "tests/fuzz/fuzz_input.h"

namespace strainwave::fuzz {

inline constexpr std::int64_t kPeriod_ns = 1'000'000;

class CheckedBus final : public CanTransmitter {
 public:
  CheckedBus(CanNode& node, std::function<bool(const CanFrame&)> has_torque)
      : ids_(node.transmit_ids()), has_torque_(std::move(has_torque)) {}

  void begin(bool fault, bool takes_frames) {
    fault_ = fault;
    takes_frames_ = takes_frames;
  }
  bool send(const CanFrame& frame) noexcept override {
    STRAINWAVE_FUZZ_CHECK(frame.size <= kMaxCanBytes);
    // A node may always send network management and SDO requests, its last resort.
    if (frame.id == 0 || (frame.id & ~0x7FU) == 0x600) return takes_frames_;
    STRAINWAVE_FUZZ_CHECK(std::find(ids_.begin(), ids_.end(), frame.id) != ids_.end());
    if (fault_) STRAINWAVE_FUZZ_CHECK(!has_torque_(frame));
    return takes_frames_;
  }

 private:
  std::vector<std::uint32_t> ids_;
  std::function<bool(const CanFrame&)> has_torque_;
  bool fault_ = false;
  bool takes_frames_ = true;
};

inline void check_reading(const ActuatorReading& reading, std::int64_t now_ns) {
  STRAINWAVE_FUZZ_CHECK(std::isfinite(reading.joint_position_rad));
  STRAINWAVE_FUZZ_CHECK(std::isfinite(reading.joint_velocity_rad_s));
  STRAINWAVE_FUZZ_CHECK(std::isfinite(reading.torque_applied_Nm));
  STRAINWAVE_FUZZ_CHECK(reading.temperature_produced_ns <= now_ns);
}

/// `has_torque`: whether a frame that the node sends orders torque.
inline void run_cycles(CanNode& node, FuzzInput& input, std::int64_t now_ns,
                       const std::function<bool(const CanFrame&)>& has_torque) {
  CheckedBus bus(node, has_torque);
  const std::vector<std::uint32_t> ids = node.receive_ids();
  while (!input.empty()) {
    const std::uint8_t order = input.byte();
    // Some pauses are long, for the time-outs.
    now_ns += kPeriod_ns * ((order & 0x80U) != 0 ? 1 + input.byte() : 1);
    node.begin_cycle(now_ns);
    for (unsigned frames = order & 0x03U; frames > 0; --frames)
      node.receive(input.frame(ids[input.byte() % ids.size()]), now_ns);
    node.note_bus((order & 0x40U) != 0 ? NodeFault{ActuatorFault::kConnectionLost, 1U << 24U} : NodeFault{});
    const ActuatorReading reading = node.read(now_ns);
    check_reading(reading, now_ns);
    if ((order & 0x10U) != 0) node.stop();
    if ((order & 0x20U) != 0) node.clear_fault();
    const bool fault = reading.fault != ActuatorFault::kNone && (order & 0x20U) == 0;
    // The loop never enables a joint in the period in which the node reports a fault.
    const bool enable = (order & 0x04U) != 0 && !fault;
    node.write({static_cast<double>(static_cast<std::int8_t>(input.byte())), enable});
    bus.begin(fault, (order & 0x08U) == 0);
    node.transmit(bus);
  }
}

}  // namespace strainwave::fuzz
