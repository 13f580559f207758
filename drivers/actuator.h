// SPDX-License-Identifier: BSD-3-Clause
// The interface between the control loop and a drive. Every kind of drive (CAN, GPIO, simulated) looks the
// same: in each period the loop reads, computes and writes. All quantities are SI units at the joint side.
//
// Real-time rules: the constructor of a driver may block, allocate and throw InputError. The real-time thread calls
// read(), write() and stop(), which never block, allocate or throw. They report trouble as a fault in the reading.
#pragma once

#include <cstdint>

namespace strainwave {

/// The power state of the drive.
enum class DriveState : std::int32_t {
  kDisabled = 0,  ///< no torque; the joint is free
  kEnabling = 1,  ///< has an order to enable and is not ready yet
  kEnabled = 2,   ///< torque commands take effect
  kFault = 3,     ///< the drive reports a fault; see ActuatorReading::fault
};

/// A fault as the driver sees it. The numbers are fixed; docs/faults.md gives cause, effect and remedy of each.
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

/// Digital inputs at the joint. True means active, whatever the polarity of the wiring. Inputs that a drive lacks stay false.
struct JointInputs {
  bool negative_limit = false;  ///< end of travel in the direction of falling position
  bool positive_limit = false;
  bool home = false;
  std::int64_t index_count = 0;     ///< index pulses of the encoder since the start
  double index_position_rad = 0.0;  ///< position of the last index pulse, counted as joint_position_rad

  /// Returns whether a motion or torque of this sign leads into an active limit switch.
  bool limit_towards(double direction) const noexcept {
    return direction < 0.0 ? negative_limit : direction > 0.0 && positive_limit;
  }
};

/// One period's measurements.
struct ActuatorReading {
  double joint_position_rad = 0.0;    ///< accumulated, not wrapped
  double joint_velocity_rad_s = 0.0;  ///< valid only when has_velocity
  double link_position_rad = 0.0;     ///< of a second encoder on the link; valid only when has_link_position
  double torque_applied_Nm = 0.0;     ///< torque that the drive applied in the last period
  bool torque_measured = false;       ///< torque_applied_Nm is a measurement, not our order
  double temperature_C = 0.0;         ///< latest known value; valid only when has_temperature
  std::int64_t temperature_produced_ns = 0;  ///< when the sensor produced the value, CLOCK_MONOTONIC
  DriveState drive_state = DriveState::kDisabled;
  ActuatorFault fault = ActuatorFault::kNone;
  JointInputs inputs;                  ///< valid in every period, even without a fresh position
  std::uint32_t drive_error = 0;       ///< reason in the driver's own numbers; 0: none
  std::int64_t position_delay_ns = 0;  ///< measured time from sampling to arrival; 0: unknown
  int position_late_periods = 0;       ///< periods by which the sample is older than usual
  bool has_position = false;           ///< false: no fresh sample in this period, the value is the last one
  bool position_lost = false;          ///< the count may be wrong: the joint must be homed again
  bool brake_shut = false;             ///< torque holds the joint while its brake opens: do not move yet
  bool has_velocity = false;
  bool has_link_position = false;
  bool has_temperature = false;
};

/// The order of one period. With enable false the driver ignores the rest and disables the drive. A torque-controlled
/// drive uses torque_Nm alone. A drive that closes its own loop adds torque_Nm to the output of that loop.
struct ActuatorCommand {
  double torque_Nm = 0.0;
  bool enable = false;
  double motor_position_rad = 0.0;    ///< setpoint, as joint_position_rad, at the end of the order's period
  double motor_velocity_rad_s = 0.0;  ///< setpoint at the joint, in the middle of the order's period
};

class Actuator {
 public:
  virtual ~Actuator() = default;
  Actuator() = default;
  Actuator(const Actuator&) = delete;
  Actuator& operator=(const Actuator&) = delete;

  /// Returns the latest measurements. `now_ns` is CLOCK_MONOTONIC at the start of this period; drivers read no clock themselves.
  virtual ActuatorReading read(std::int64_t now_ns) noexcept = 0;
  /// Sends the order of this period.
  virtual void write(const ActuatorCommand& command) noexcept = 0;
  /// Zero torque and disable, by the safest way the drive has. May be called at any time and repeatedly.
  virtual void stop() noexcept = 0;
  /// Clears the drive's latched fault. Called only on an operator's order. The drive stays disabled.
  virtual void clear_fault() noexcept = 0;
};

}  // namespace strainwave
