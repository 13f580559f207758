// SPDX-License-Identifier: BSD-3-Clause
// One drive on a CAN bus, of whatever protocol: what the bus calls besides the four functions of Actuator.
// See can_bus.h for the order of calls.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/actuator.h"
#include "drivers/can/bus_load.h"
#include "drivers/can/can_frame.h"
#include "drivers/can/can_port.h"

namespace strainwave {

/// What a node may do with its bus while the loop runs. Real-time safe.
class CanTransmitter {
 public:
  virtual ~CanTransmitter() = default;
  /// False: the frame was dropped, because the bus did not take the last period's frames or is not there.
  virtual bool send(const CanFrame& frame) noexcept = 0;
};

/// A fault with its reason.
struct NodeFault {
  ActuatorFault fault = ActuatorFault::kNone;
  std::uint32_t drive_error = 0;
};

class CanNode : public Actuator {
 public:
  // Before the loop, and on the bus's background thread: these may block, allocate, and throw InputError.

  virtual const std::string& name() const noexcept = 0;
  /// Identifiers that the node's frames have in the loop, and those that only we may send.
  virtual std::vector<std::uint32_t> receive_ids() const = 0;
  virtual std::vector<std::uint32_t> transmit_ids() const = 0;
  /// Identifiers of answers during set-up.
  virtual std::vector<std::uint32_t> setup_ids() const = 0;
  /// All that it and we send on its behalf.
  virtual std::vector<FrameTraffic> traffic() const = 0;
  /// Finds, checks and configures the drive, which stays disabled. Returns lines for the log.
  virtual std::vector<std::string> set_up(CanPort& port) = 0;
  /// Sees that the configured drive sends what the loop needs. Returns lines for the log.
  virtual std::vector<std::string> verify(CanPort& port) = 0;
  /// A turn of the bus's background thread: slow readings, a set-up that clear_fault() asked for. Returns
  /// lines for the log.
  virtual std::vector<std::string> serve(CanPort& port) = 0;
  /// Right after the last cycle: the drive must not miss our frames any more. Never waits.
  virtual void end_operation(CanPort& /*port*/) noexcept {}
  /// After that: leaves the drive disabled, in order. Does not throw.
  virtual void shut_down(CanPort& port) noexcept = 0;

  // In the loop, real-time safe, besides read(), write(), stop() and clear_fault(), which only look and note.

  virtual void begin_cycle(std::int64_t now_ns) noexcept = 0;
  /// A SYNC was on the bus, at this time of the kernel; 0: unknown.
  virtual void note_sync(std::int64_t /*kernel_time_ns*/) noexcept {}
  /// A frame of ours has gone out, at this time of the kernel; 0: unknown.
  virtual void note_own(const CanFrame& /*frame*/, std::int64_t /*kernel_time_ns*/) noexcept {}
  /// A data frame with one of receive_ids(), and when the kernel saw it. Untrusted.
  virtual void receive(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept = 0;
  /// The bus itself is in trouble: told each cycle, between the frames and read(); kNone when it is not.
  virtual void note_bus(const NodeFault& trouble) noexcept = 0;
  /// Sends this period's frames, after every joint wrote.
  virtual void transmit(CanTransmitter& bus) noexcept = 0;
  /// Our heartbeat must end: the drive has torque, obeys nothing, and will stop only for want of it.
  virtual bool withdraws_heartbeat() const noexcept { return false; }
};

}  // namespace strainwave
