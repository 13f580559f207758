// SPDX-License-Identifier: BSD-3-Clause
// What every kind of drive on a CAN bus is watched for alike, and the latch of its faults. Real-time safe.
//
// A trouble is either there as long as its cause lasts, in use or not (`connection_trouble`), or it concerns only a drive that is in
// use, which its node knows. Of a drive in use the first trouble is latched; only an operator's clear() ends it. Of a drive
// that is not in use the present one is shown, so that enabling shows why it cannot be.
#pragma once

#include <cstdint>

#include "drivers/can/can_detail.h"
#include "drivers/can/can_node.h"
#include "drivers/can/set_up_state.h"

namespace strainwave {

class NodeWatch {
 public:
  /// `detail_mark` is set in each drive_error that holds a CanDetail: for protocols whose own error numbers need telling apart.
  explicit NodeWatch(std::int64_t heartbeat_timeout_ns, std::uint32_t detail_mark = 0) noexcept
      : heartbeat_timeout_ns_(heartbeat_timeout_ns), detail_mark_(detail_mark) {}

  // The present.

  /// Each cycle: the trouble of the bus; kNone when it is well.
  void note_bus(const NodeFault& trouble) noexcept {
    bus_trouble_ = trouble;
    if (trouble.fault != ActuatorFault::kNone) bus_trouble_.drive_error |= detail_mark_;
  }
  bool bus_is_well() const noexcept { return bus_trouble_.fault == ActuatorFault::kNone; }
  /// The drive was heard, or has been set up.
  void hear(std::int64_t now_ns) noexcept { heard_ns_ = now_ns; }
  /// Bus, failed set-up, heartbeat, in this order. A drive that is being set up has no trouble.
  NodeFault connection_trouble(const SetUpState& setup, std::int64_t now_ns) const noexcept {
    if (!bus_is_well()) return bus_trouble_;
    if (setup.failed()) return trouble(ActuatorFault::kDriveRestarted, CanDetail::kSetupFailed);
    if (setup.ready() && now_ns - heard_ns_ > heartbeat_timeout_ns_)
      return trouble(ActuatorFault::kConnectionLost, CanDetail::kHeartbeatMissing);
    return {};
  }
  /// A fault with one of our reasons.
  NodeFault trouble(ActuatorFault fault, CanDetail detail, std::uint32_t value = 0) const noexcept {
    return {fault, detail_mark_ | drive_error_of(detail, value)};
  }

  // The latch.

  /// Keeps `fault` unless it is none, or one is kept already.
  void latch(const NodeFault& fault) noexcept {
    if (latched_.fault == ActuatorFault::kNone) latched_ = fault;
  }
  bool latched() const noexcept { return latched_.fault != ActuatorFault::kNone; }
  const NodeFault& latched_fault() const noexcept { return latched_; }
  /// What a reading tells: the latched fault, else the present one.
  NodeFault shown(const NodeFault& present) const noexcept { return latched() ? latched_ : present; }
  /// On an operator's order.
  void clear() noexcept { latched_ = {}; }

 private:
  std::int64_t heartbeat_timeout_ns_;
  std::uint32_t detail_mark_;
  std::int64_t heard_ns_ = 0;
  NodeFault bus_trouble_;
  NodeFault latched_;
};

}  // namespace strainwave
