// SPDX-License-Identifier: BSD-3-Clause
// ODrive's CANSimple protocol, firmware 0.6: identifiers, frames, error bits. Pure functions, real-time safe
// except for the texts. The decoders take untrusted frames: they check sizes and refuse numbers that are not
// finite. Source: ODrive documentation, "CAN Protocol" and "ODrive.Axis.Error", firmware 0.6.10. Firmware 0.5
// uses some identifiers otherwise: check the version.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/can/can_frame.h"

namespace strainwave::odrive {

inline constexpr std::uint8_t kMaxNodeId = 63;

enum class Command : std::uint8_t {
  kVersion = 0x00,
  kHeartbeat = 0x01,
  kErrors = 0x03,
  kReadParameter = 0x04,  ///< RxSdo in the documentation
  kParameter = 0x05,      ///< TxSdo in the documentation
  kSetAxisState = 0x07,
  kEstimates = 0x09,
  kSetControllerMode = 0x0B,
  kSetPosition = 0x0C,
  kSetVelocity = 0x0D,
  kSetTorque = 0x0E,
  kTemperatures = 0x15,
  kSupply = 0x17,
  kClearErrors = 0x18,
  kTorques = 0x1C,
};
constexpr std::uint32_t can_id(Command command, std::uint8_t node) noexcept {
  return static_cast<std::uint32_t>(node) << 5U | static_cast<std::uint32_t>(command);
}

enum class AxisState : std::uint8_t { kUndefined = 0, kIdle = 1, kClosedLoop = 8 };
enum class ControlMode : std::uint8_t { kTorque = 1, kVelocity = 2, kPosition = 3 };

/// Axis errors that map to a more specific fault than kDriveFault.
inline constexpr std::uint32_t kOverVoltage = 0x100;
inline constexpr std::uint32_t kUnderVoltage = 0x200;
inline constexpr std::uint32_t kWatchdogExpired = 0x1000000;
inline constexpr std::uint32_t kEstopRequested = 0x2000000;
/// Returns "MOTOR_OVER_TEMP, WATCHDOG_TIMER_EXPIRED"; unknown bits appear as a number.
std::string error_text(std::uint32_t errors);

struct Version {
  std::uint8_t protocol = 0;
  std::uint8_t firmware_major = 0;
  std::uint8_t firmware_minor = 0;
  std::uint8_t firmware_revision = 0;
};
struct Heartbeat {
  std::uint32_t errors = 0;
  AxisState state = AxisState::kUndefined;  ///< other numbers are procedures (calibration, homing)
  std::uint8_t procedure_result = 0;        ///< 0: success, 3: disarmed
};
/// Position and velocity of the drive's encoder, in its turns.
struct Estimates {
  double position_turns = 0.0;
  double velocity_turns_s = 0.0;
};
/// Empty where the drive has no sensor.
struct Temperatures {
  std::optional<double> inverter_C;
  std::optional<double> motor_C;
};

/// Largest magnitude of the 16-bit numbers in position_frame().
inline constexpr double kMostUnits = 32767.0;

// The decoders return nothing for a frame of another size or with a number that is not finite. One finite temperature is enough.
std::optional<Version> decode_version(const CanFrame& frame) noexcept;
std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame) noexcept;
std::optional<Estimates> decode_estimates(const CanFrame& frame) noexcept;
std::optional<Temperatures> decode_temperatures(const CanFrame& frame) noexcept;
/// Torque in N m that the drive estimates, on its side.
std::optional<double> decode_torque_Nm(const CanFrame& frame) noexcept;

/// Returns a parameter requested with read_parameter_frame(): a boolean or a REAL32.
std::optional<bool> decode_parameter_bool(const CanFrame& frame, std::uint16_t endpoint) noexcept;
std::optional<double> decode_parameter_float(const CanFrame& frame, std::uint16_t endpoint) noexcept;

/// Requests the message of `command`; a remote frame.
CanFrame request_frame(std::uint8_t node, Command command) noexcept;
CanFrame axis_state_frame(std::uint8_t node, AxisState state) noexcept;
/// Selects passthrough: the drive neither filters nor interpolates its input.
CanFrame mode_frame(std::uint8_t node, ControlMode mode) noexcept;
// Numbers are on the drive's side and must be finite.
CanFrame torque_frame(std::uint8_t node, double torque_Nm) noexcept;
CanFrame velocity_frame(std::uint8_t node, double velocity_turns_s, double torque_Nm) noexcept;
/// Velocity and torque in units of the drive's settings, clamped to 16 bits.
CanFrame position_frame(std::uint8_t node, double position_turns, double velocity_units,
                        double torque_units) noexcept;
CanFrame clear_errors_frame(std::uint8_t node) noexcept;
/// `endpoint` is the parameter's number in the firmware's flat_endpoints.json.
CanFrame read_parameter_frame(std::uint8_t node, std::uint16_t endpoint) noexcept;

}  // namespace strainwave::odrive
