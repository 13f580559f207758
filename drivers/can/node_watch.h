// SPDX-License-Identifier: BSD-3-Clause
// Supervision that all kinds of drives on a CAN bus share, and the latch of their faults. Real-time safe.
//
// A fault is of one of two kinds. Connection faults (`connection_trouble`) exist as long as their cause, whether the drive is in
// use or not. The node itself detects faults that concern only a drive in use. In use, the first fault is latched until an
// operator's clear(). Otherwise the present fault is shown, so that a failed enabling has a visible reason.
#pragma once

#include <cstdint>

#include "drivers/can/can_detail.h"
#include "drivers/can/can_node.h"
#include "drivers/can/set_up_state.h"

namespace strainwave {

class NodeWatch {
 public:
  /// `detail_mark` is set in each drive_error with a CanDetail, for protocols whose own error numbers could be confused with it.
  explicit NodeWatch(std::int64_t heartbeat_timeout_ns, std::uint32_t detail_mark = 0) noexcept
      : heartbeat_timeout_ns_(heartbeat_timeout_ns), detail_mark_(detail_mark) {}

  // The present fault.

  /// Takes the fault of the bus, once in each cycle; kNone when there is none.
  void note_bus(const NodeFault& trouble) noexcept {
    bus_trouble_ = trouble;
    if (trouble.fault != ActuatorFault::kNone) bus_trouble_.drive_error |= detail_mark_;
  }
  bool bus_is_well() const noexcept { return bus_trouble_.fault == ActuatorFault::kNone; }
  /// The drive sent a sign of life, or has been set up.
  void hear(std::int64_t now_ns) noexcept { heard_ns_ = now_ns; }
  /// Returns the first of: bus fault, failed set-up, missing heartbeat. A drive during set-up has no fault.
  NodeFault connection_trouble(const SetUpState& setup, std::int64_t now_ns) const noexcept {
    if (!bus_is_well()) return bus_trouble_;
    if (setup.failed()) return trouble(ActuatorFault::kDriveRestarted, CanDetail::kSetupFailed);
    if (setup.ready() && now_ns - heard_ns_ > heartbeat_timeout_ns_)
      return trouble(ActuatorFault::kConnectionLost, CanDetail::kHeartbeatMissing);
    return {};
  }
  /// Returns a fault with one of our reasons.
  NodeFault trouble(ActuatorFault fault, CanDetail detail, std::uint32_t value = 0) const noexcept {
    return {fault, detail_mark_ | drive_error_of(detail, value)};
  }

  // The latch.

  /// Latches `fault` unless it is none or another one is latched.
  void latch(const NodeFault& fault) noexcept {
    if (latched_.fault == ActuatorFault::kNone) latched_ = fault;
  }
  bool latched() const noexcept { return latched_.fault != ActuatorFault::kNone; }
  const NodeFault& latched_fault() const noexcept { return latched_; }
  /// Returns the fault for a reading: the latched one, else the present one.
  NodeFault shown(const NodeFault& present) const noexcept { return latched() ? latched_ : present; }
  /// Called on an operator's order.
  void clear() noexcept { latched_ = {}; }

 private:
  std::int64_t heartbeat_timeout_ns_;
  std::uint32_t detail_mark_;
  std::int64_t heard_ns_ = 0;
  NodeFault bus_trouble_;
  NodeFault latched_;
};

}  // namespace strainwave
