// SPDX-License-Identifier: BSD-3-Clause
// One drive on a CAN bus, of any protocol: the functions that the bus calls in addition to those of Actuator.
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

/// What a node may do with its bus in the loop. Real-time safe.
class CanTransmitter {
 public:
  virtual ~CanTransmitter() = default;
  /// Returns false when the frame was dropped: the bus did not take the last period's frames, or is not there.
  virtual bool send(const CanFrame& frame) noexcept = 0;
};

/// A fault with its reason.
struct NodeFault {
  ActuatorFault fault = ActuatorFault::kNone;
  std::uint32_t drive_error = 0;
};

class CanNode : public Actuator {
 public:
  // Called before the loop and on the background thread of the bus: may block, allocate, and throw InputError.

  virtual const std::string& name() const noexcept = 0;
  /// Identifiers of the frames that the node sends in the loop, and identifiers that only we may send.
  virtual std::vector<std::uint32_t> receive_ids() const = 0;
  virtual std::vector<std::uint32_t> transmit_ids() const = 0;
  /// Identifiers of answers during set-up.
  virtual std::vector<std::uint32_t> setup_ids() const = 0;
  /// All frames that the drive sends, and those that we send to it.
  virtual std::vector<FrameTraffic> traffic() const = 0;
  /// Finds, checks and configures the drive, which stays disabled. Returns lines for the log.
  virtual std::vector<std::string> set_up(CanPort& port) = 0;
  /// Checks that the configured drive sends what the loop needs. Returns lines for the log.
  virtual std::vector<std::string> verify(CanPort& port) = 0;
  /// Runs on the background thread of the bus: slow readings, and the set-up that clear_fault() requested.
  /// Returns lines for the log.
  virtual std::vector<std::string> serve(CanPort& port) = 0;
  /// Called right after the last cycle, so that the drive no longer expects our frames. Never waits.
  virtual void end_operation(CanPort& /*port*/) noexcept {}
  /// Called after end_operation(): leaves the drive disabled. Does not throw.
  virtual void shut_down(CanPort& port) noexcept = 0;

  // The loop calls these in addition to read(), write(), stop() and clear_fault(), which send nothing. All are real-time safe.

  virtual void begin_cycle(std::int64_t now_ns) noexcept = 0;
  /// A SYNC was on the bus at this kernel time; 0: unknown.
  virtual void note_sync(std::int64_t /*kernel_time_ns*/) noexcept {}
  /// Our frame went out at this kernel time; 0: unknown.
  virtual void note_own(const CanFrame& /*frame*/, std::int64_t /*kernel_time_ns*/) noexcept {}
  /// Takes a data frame with one of receive_ids() and its kernel time. The content is untrusted.
  virtual void receive(const CanFrame& frame, std::int64_t kernel_time_ns) noexcept = 0;
  /// Reports the fault of the bus itself, kNone when there is none. Called each cycle between receive() and read().
  virtual void note_bus(const NodeFault& trouble) noexcept = 0;
  /// Sends the frames of this period, after every joint wrote.
  virtual void transmit(CanTransmitter& bus) noexcept = 0;
  /// Returns true when our heartbeat must end: the drive has torque, obeys no order, and stops only without the heartbeat.
  virtual bool withdraws_heartbeat() const noexcept { return false; }
};

}  // namespace strainwave
