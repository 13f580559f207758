// SPDX-License-Identifier: BSD-3-Clause
// The seam between the loop and a drive. Everything behind it (CAN, GPIO, the simulated plant) looks the same: once a
// period the loop reads, computes, writes. All quantities at the joint side, SI.
//
// Real-time rules: the constructor of a driver may block, allocate and throw InputError. The real-time thread calls
// read(), write() and stop(), which never block, allocate or throw. They report trouble as a fault in the reading.
#pragma once

#include <cstdint>

namespace strainwave {

/// What the drive itself can do for us now.
enum class DriveState : std::int32_t {
  kDisabled = 0,  ///< no torque; the joint is free
  kEnabling = 1,  ///< asked to enable, still on its way
  kEnabled = 2,   ///< torque commands take effect
  kFault = 3,     ///< the drive reports a fault; see ActuatorReading::fault
};

/// Trouble as the driver sees it. Numbers are fixed; docs/faults.md has the cause, effect and remedy of each.
enum class ActuatorFault : std::int32_t {
  kNone = 0,
  kReadFailed = 1,      ///< no fresh position for longer than the driver tolerates
  kWriteRefused = 2,    ///< the drive did not take the torque command
  kDriveFault = 3,      ///< the drive reports its own fault
  kPowerLost = 4,       ///< supply absent or out of range
  kImplausible = 5,     ///< the reading contradicts itself (stuck, jumped, not finite)
  kConnectionLost = 6,  ///< bus or device gone
  kEmergencyStop = 7,   ///< the e-stop input is active
  kDriveRestarted = 8,  ///< the drive has restarted by itself and forgotten its settings
  kBusError = 9,        ///< the bus's controller counts too many errors
};

/// Digital inputs at the joint; true: active, whatever the wiring's polarity. What a drive does not have stays false.
struct JointInputs {
  bool negative_limit = false;  ///< end of travel in the direction of falling position
  bool positive_limit = false;
  bool home = false;
  std::int64_t index_count = 0;     ///< pulses of the encoder's index since the start
  double index_position_rad = 0.0;  ///< where the last one was, counted as joint_position_rad

  /// Whether a motion or torque of this sign leads into a limit switch that is closed.
  bool limit_towards(double direction) const noexcept {
    return direction < 0.0 ? negative_limit : direction > 0.0 && positive_limit;
  }
};

/// One period's measurements.
struct ActuatorReading {
  double joint_position_rad = 0.0;    ///< accumulated, not wrapped
  double joint_velocity_rad_s = 0.0;  ///< valid only when has_velocity
  double link_position_rad = 0.0;     ///< of a second encoder, on the link; valid only when has_link_position
  double torque_applied_Nm = 0.0;     ///< what the drive says it applied last period
  bool torque_measured = false;       ///< that is a measurement, and no order of ours
  double temperature_C = 0.0;         ///< latest known value; valid only when has_temperature
  std::int64_t temperature_produced_ns = 0;  ///< when the sensor produced it, CLOCK_MONOTONIC
  DriveState drive_state = DriveState::kDisabled;
  ActuatorFault fault = ActuatorFault::kNone;
  JointInputs inputs;                  ///< of this period, even without a fresh position
  std::uint32_t drive_error = 0;       ///< why, in the driver's own numbers; 0: nothing to say
  std::int64_t position_delay_ns = 0;  ///< from its sampling until it came, measured; 0: not known
  int position_late_periods = 0;       ///< sampled so many periods before the drive's usual delay has it
  bool has_position = false;           ///< false: no fresh sample this period, the value is the last one
  bool position_lost = false;          ///< the count may be wrong: to be homed before it is believed
  bool brake_shut = false;             ///< torque holds the joint while its brake opens: no motion yet
  bool has_velocity = false;
  bool has_link_position = false;
  bool has_temperature = false;
};

/// One period's order. With enable false the rest is ignored and the drive is brought to kDisabled. A drive that obeys torque takes the
/// torque alone; one that closes its own loop takes torque as what it adds to that loop's.
struct ActuatorCommand {
  double torque_Nm = 0.0;
  bool enable = false;
  double motor_position_rad =
      0.0;  ///< as joint_position_rad is read, at the end of the period over which the order acts
  double motor_velocity_rad_s = 0.0;  ///< in its middle, at the joint
};

class Actuator {
 public:
  virtual ~Actuator() = default;
  Actuator() = default;
  Actuator(const Actuator&) = delete;
  Actuator& operator=(const Actuator&) = delete;

  /// Latest measurements. `now_ns` is CLOCK_MONOTONIC at the start of this period; drivers read no clock themselves.
  virtual ActuatorReading read(std::int64_t now_ns) noexcept = 0;
  /// Sends this period's order.
  virtual void write(const ActuatorCommand& command) noexcept = 0;
  /// Zero torque and disable, by the surest way the drive knows. May be called at any time, repeatedly.
  virtual void stop() noexcept = 0;
  /// Clears the drive's latched fault, on an operator's order only. The drive stays disabled.
  virtual void clear_fault() noexcept = 0;
};

}  // namespace strainwave
