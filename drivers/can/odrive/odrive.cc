// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/odrive/odrive.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

namespace strainwave::odrive {

namespace {

constexpr std::uint32_t kPassthrough = 1;
constexpr std::uint8_t kRead = 0;

struct ErrorName {
  std::uint32_t bit;
  const char* name;
};
constexpr std::array<ErrorName, 21> kErrorNames{{{0x1, "INITIALIZING"},
                                                 {0x2, "SYSTEM_LEVEL"},
                                                 {0x4, "TIMING_ERROR"},
                                                 {0x8, "MISSING_ESTIMATE"},
                                                 {0x10, "BAD_CONFIG"},
                                                 {0x20, "DRV_FAULT"},
                                                 {0x40, "MISSING_INPUT"},
                                                 {kOverVoltage, "DC_BUS_OVER_VOLTAGE"},
                                                 {kUnderVoltage, "DC_BUS_UNDER_VOLTAGE"},
                                                 {0x400, "DC_BUS_OVER_CURRENT"},
                                                 {0x800, "DC_BUS_OVER_REGEN_CURRENT"},
                                                 {0x1000, "CURRENT_LIMIT_VIOLATION"},
                                                 {0x2000, "MOTOR_OVER_TEMP"},
                                                 {0x4000, "INVERTER_OVER_TEMP"},
                                                 {0x8000, "VELOCITY_LIMIT_VIOLATION"},
                                                 {0x10000, "POSITION_LIMIT_VIOLATION"},
                                                 {kWatchdogExpired, "WATCHDOG_TIMER_EXPIRED"},
                                                 {kEstopRequested, "ESTOP_REQUESTED"},
                                                 {0x4000000, "SPINOUT_DETECTED"},
                                                 {0x8000000, "BRAKE_RESISTOR_DISARMED"},
                                                 {0x10000000, "THERMISTOR_DISCONNECTED"}}};
constexpr ErrorName kCalibrationError{0x40000000, "CALIBRATION_ERROR"};

std::uint32_t word_at(const CanFrame& frame, std::size_t offset) noexcept {
  return static_cast<std::uint32_t>(little_endian(&frame.bytes[offset], 4));
}

double float_at(const CanFrame& frame, std::size_t offset) noexcept {
  return static_cast<double>(std::bit_cast<float>(word_at(frame, offset)));
}

/// Two REAL32 that fill a frame.
struct Pair {
  double first = 0.0;
  double second = 0.0;
};
std::optional<Pair> decode_pair(const CanFrame& frame) noexcept {
  if (frame.size != kMaxCanBytes) return std::nullopt;
  const Pair pair{float_at(frame, 0), float_at(frame, 4)};
  if (!std::isfinite(pair.first) || !std::isfinite(pair.second)) return std::nullopt;
  return pair;
}

void put_float(CanFrame& frame, std::size_t offset, double value) noexcept {
  put_little_endian(&frame.bytes[offset], 4, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

void put_int16(CanFrame& frame, std::size_t offset, double value) noexcept {
  const auto rounded = static_cast<std::int16_t>(std::lround(std::clamp(value, -kMostUnits, kMostUnits)));
  put_little_endian(&frame.bytes[offset], 2, static_cast<std::uint16_t>(rounded));
}

CanFrame frame_of(std::uint8_t node, Command command, std::size_t size) noexcept {
  CanFrame frame;
  frame.id = can_id(command, node);
  frame.size = static_cast<std::uint8_t>(size);
  return frame;
}

bool answers(const CanFrame& frame, std::uint16_t endpoint, std::size_t least_size) noexcept {
  return frame.size >= least_size && little_endian(&frame.bytes[1], 2) == endpoint;
}

}  // namespace

std::string error_text(std::uint32_t errors) {
  std::string text;
  const auto add = [&text](const std::string& name) { text += (text.empty() ? "" : ", ") + name; };
  std::uint32_t unknown = errors;
  const auto add_named = [&](const ErrorName& error) {
    if ((errors & error.bit) != 0) add(error.name);
    unknown &= ~error.bit;
  };
  for (const ErrorName& error : kErrorNames) add_named(error);
  add_named(kCalibrationError);
  if (unknown != 0) {
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "0x%X", unknown);
    add(number.data());
  }
  return text.empty() ? "no error" : text;
}

std::optional<Version> decode_version(const CanFrame& frame) noexcept {
  if (frame.size != kMaxCanBytes) return std::nullopt;
  return Version{frame.bytes[0], frame.bytes[4], frame.bytes[5], frame.bytes[6]};
}

std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame) noexcept {
  if (frame.size != kMaxCanBytes) return std::nullopt;
  return Heartbeat{word_at(frame, 0), static_cast<AxisState>(frame.bytes[4]), frame.bytes[5]};
}

std::optional<Estimates> decode_estimates(const CanFrame& frame) noexcept {
  const std::optional<Pair> pair = decode_pair(frame);
  if (!pair) return std::nullopt;
  return Estimates{pair->first, pair->second};
}

// The first number of the frame is the torque setpoint of the drive's loop.
std::optional<double> decode_torque_Nm(const CanFrame& frame) noexcept {
  const std::optional<Pair> pair = decode_pair(frame);
  return pair ? std::optional(pair->second) : std::nullopt;
}

std::optional<Temperatures> decode_temperatures(const CanFrame& frame) noexcept {
  if (frame.size != kMaxCanBytes) return std::nullopt;
  const auto finite = [&frame](std::size_t offset) {
    const double value = float_at(frame, offset);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  const Temperatures temperatures{finite(0), finite(4)};
  if (!temperatures.inverter_C && !temperatures.motor_C) return std::nullopt;
  return temperatures;
}

std::optional<bool> decode_parameter_bool(const CanFrame& frame, std::uint16_t endpoint) noexcept {
  if (!answers(frame, endpoint, 5) || frame.bytes[4] > 1) return std::nullopt;
  return frame.bytes[4] != 0;
}

std::optional<double> decode_parameter_float(const CanFrame& frame, std::uint16_t endpoint) noexcept {
  if (!answers(frame, endpoint, 8)) return std::nullopt;
  const double value = float_at(frame, 4);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

CanFrame request_frame(std::uint8_t node, Command command) noexcept {
  CanFrame frame = frame_of(node, command, 0);
  frame.remote = true;
  return frame;
}

CanFrame axis_state_frame(std::uint8_t node, AxisState state) noexcept {
  CanFrame frame = frame_of(node, Command::kSetAxisState, 4);
  put_little_endian(frame.bytes.data(), 4, static_cast<std::uint64_t>(state));
  return frame;
}

CanFrame mode_frame(std::uint8_t node, ControlMode mode) noexcept {
  CanFrame frame = frame_of(node, Command::kSetControllerMode, 8);
  put_little_endian(&frame.bytes[0], 4, static_cast<std::uint64_t>(mode));
  put_little_endian(&frame.bytes[4], 4, kPassthrough);
  return frame;
}

CanFrame torque_frame(std::uint8_t node, double torque_Nm) noexcept {
  CanFrame frame = frame_of(node, Command::kSetTorque, 4);
  put_float(frame, 0, torque_Nm);
  return frame;
}

CanFrame velocity_frame(std::uint8_t node, double velocity_turns_s, double torque_Nm) noexcept {
  CanFrame frame = frame_of(node, Command::kSetVelocity, 8);
  put_float(frame, 0, velocity_turns_s);
  put_float(frame, 4, torque_Nm);
  return frame;
}

CanFrame position_frame(std::uint8_t node, double position_turns, double velocity_units,
                        double torque_units) noexcept {
  CanFrame frame = frame_of(node, Command::kSetPosition, 8);
  put_float(frame, 0, position_turns);
  put_int16(frame, 4, velocity_units);
  put_int16(frame, 6, torque_units);
  return frame;
}

CanFrame clear_errors_frame(std::uint8_t node) noexcept {
  return frame_of(node, Command::kClearErrors, 1);
}

CanFrame read_parameter_frame(std::uint8_t node, std::uint16_t endpoint) noexcept {
  CanFrame frame = frame_of(node, Command::kReadParameter, 4);
  frame.bytes[0] = kRead;
  put_little_endian(&frame.bytes[1], 2, endpoint);
  return frame;
}

}  // namespace strainwave::odrive
