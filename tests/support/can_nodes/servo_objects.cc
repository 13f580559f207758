// SPDX-License-Identifier: BSD-3-Clause
// The object dictionary of servo_drive.h: its objects, and the values that they show.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "tests/support/can_nodes/servo_drive.h"

namespace strainwave::can_nodes {

void ServoDrive::add_objects() {
  using enum DataType;
  const auto variable = [&](std::uint16_t index, DataType type, Mappable mappable, std::int64_t value = 0) {
    dictionary_.add({index, 0}, {type, Access::kReadOnly, value, mappable});
  };
  const auto setting = [&](std::uint16_t index, DataType type, std::int64_t value, std::int64_t low,
                           std::int64_t high, Mappable mappable = Mappable::kNo) {
    dictionary_.add({index, 0}, {type, Access::kReadWrite, value, mappable, low, high, {}});
  };
  setting(0x6007, kInteger16, 1, 0, 3);
  variable(0x603F, kUnsigned16, Mappable::kTransmit);
  setting(0x6040, kUnsigned16, 0, 0, 0xFFFF, Mappable::kBoth);
  variable(0x6041, kUnsigned16, Mappable::kTransmit);
  setting(0x605A, kInteger16, 2, 0, 6);
  setting(0x605E, kInteger16, 2, 0, 2);
  setting(0x6060, kInteger8, 0, -128, 127, Mappable::kBoth);
  variable(0x6061, kInteger8, Mappable::kTransmit);
  variable(0x6064, kInteger32, Mappable::kTransmit);
  variable(0x606C, kInteger32, Mappable::kTransmit);
  setting(0x6065, kUnsigned32, UINT32_MAX, 0, UINT32_MAX);
  setting(0x607A, kInteger32, 0, INT32_MIN, INT32_MAX, Mappable::kBoth);
  setting(0x60B1, kInteger32, 0, INT32_MIN, INT32_MAX, Mappable::kBoth);
  setting(0x60FF, kInteger32, 0, INT32_MIN, INT32_MAX, Mappable::kBoth);
  dictionary_.add({0x60C1, 0}, {kUnsigned8, Access::kConstant, 1});
  dictionary_.add({0x60C1, 1},
                  {kInteger32, Access::kReadWrite, 0, Mappable::kBoth, INT32_MIN, INT32_MAX, {}});
  setting(0x6071, kInteger16, 0, INT16_MIN, INT16_MAX, Mappable::kBoth);
  setting(0x6072, kUnsigned16, 1000, 0, UINT16_MAX, Mappable::kBoth);
  variable(0x6074, kInteger16, Mappable::kTransmit);
  variable(0x6075, kUnsigned32, Mappable::kNo, std::llround(config_.rated_current_A * 1e3));
  variable(0x6076, kUnsigned32, Mappable::kNo,
           std::llround(config_.rated_torque_Nm * config_.rated_torque_units_per_Nm));
  variable(0x6077, kInteger16, Mappable::kTransmit);
  setting(0x607E, kUnsigned8, 0, 0, 255);
  setting(0x60B2, kInteger16, 0, INT16_MIN, INT16_MAX, Mappable::kBoth);
  setting(0x60E0, kUnsigned16, 1000, 0, UINT16_MAX, Mappable::kBoth);
  setting(0x60E1, kUnsigned16, 1000, 0, UINT16_MAX, Mappable::kBoth);
  variable(0x60FD, kUnsigned32, Mappable::kTransmit);
  setting(0x60B8, kUnsigned16, 0, 0, 0xFFFF, Mappable::kBoth);
  variable(0x60B9, kUnsigned16, Mappable::kTransmit);
  variable(0x60BA, kInteger32, Mappable::kTransmit);
  setting(0x6087, kUnsigned32, 1000000, 1, UINT32_MAX);
  dictionary_.add({0x60C2, 0}, {kUnsigned8, Access::kConstant, 2});
  dictionary_.add({0x60C2, 1}, {kUnsigned8, Access::kReadWrite, 1, Mappable::kNo, 1, 255, {}});
  dictionary_.add({0x60C2, 2}, {kInteger8, Access::kReadWrite, -3, Mappable::kNo, -6, 0, {}});
  variable(0x6502, kUnsigned32, Mappable::kNo,
           (config_.has_cst ? 1 << 9 : 0) | (config_.has_tq ? 1 << 3 : 0) | (config_.has_ip ? 1 << 6 : 0) |
               (config_.has_csp ? 1 << 7 : 0) | (config_.has_csv ? 1 << 8 : 0));

  const Key temperature = config_.temperature.key;
  if (temperature.sub != 0)
    dictionary_.add({temperature.index, 0}, {kUnsigned8, Access::kConstant, temperature.sub});
  dictionary_.add(temperature, {config_.temperature.type, Access::kReadOnly, 0, Mappable::kTransmit});

  dictionary_.guard(0x6060, 0x6060, [this](Key, std::int64_t mode) {
    const bool has = mode == 0 || (mode == kModeCyclicTorque && config_.has_cst) ||
                     (mode == kModeTorqueProfile && config_.has_tq) ||
                     (mode == kModeInterpolatedPosition && config_.has_ip) ||
                     (mode == kModeCyclicPosition && config_.has_csp) ||
                     (mode == kModeCyclicVelocity && config_.has_csv);
    return has ? Abort::kNone : Abort::kInvalidValue;
  });
}

double ServoDrive::direction() const {
  return config_.joint_torque_per_drive_torque < 0.0 ? -1.0 : 1.0;
}

double ServoDrive::drive_counts() const {
  return direction() * plant_.measured_position_rad() / (2.0 * std::numbers::pi) *
         config_.counts_per_joint_revolution;
}

// Touch probe 1 latches the first rising edge of the index after it is enabled.
void ServoDrive::probe_index(double counts_before, double counts_now) {
  constexpr std::int64_t kEnable = 1;
  constexpr std::int64_t kIndexRises = 1 << 2 | 1 << 4;
  constexpr std::int64_t kLatched = 1 << 1;
  if (dictionary_.find({0x60B8, 0}) == nullptr) return;
  const std::int64_t function = dictionary_.number({0x60B8, 0});
  const bool enabled = (function & kEnable) != 0;
  const bool latched = (dictionary_.number({0x60B9, 0}) & kLatched) != 0;
  dictionary_.set({0x60B9, 0}, enabled ? kEnable | (latched ? kLatched : 0) : 0);
  const double before = std::floor(counts_before / config_.counts_per_index);
  const double now = std::floor(counts_now / config_.counts_per_index);
  if (!enabled || latched || (function & kIndexRises) != kIndexRises || before == now) return;
  dictionary_.set({0x60BA, 0}, std::llround(std::max(before, now) * config_.counts_per_index));
  dictionary_.set({0x60B9, 0}, kEnable | kLatched);
}

void ServoDrive::show_state() {
  // The drive's counter is a 32-bit register, which wraps.
  dictionary_.set({0x6064, 0}, static_cast<std::int32_t>(std::llround(drive_counts())));
  dictionary_.set({0x606C, 0}, static_cast<std::int32_t>(std::llround(direction() * velocity_counts_s_)));
  const auto permille = [&](double torque_Nm) {
    return static_cast<std::int16_t>(std::clamp(torque_Nm / joint_torque_per_permille(), -32768.0, 32767.0));
  };
  dictionary_.set({0x6074, 0}, permille(demand_Nm_));
  dictionary_.set({0x6077, 0}, permille(plant_.applied_torque_Nm()));
  const unsigned status =
      status_bits(power_) | 1U << 4 | 1U << 9 | (limited_ ? 1U << 11 : 0U) | (follows() ? 1U << 12 : 0U);
  dictionary_.set({0x6041, 0}, status);
}

void ServoDrive::show_temperature() {
  since_temperature_us_ = 0;
  const double temperature_C = plant_.sensor_temperature_C();
  const TemperatureObject& object = config_.temperature;
  dictionary_.set(object.key,
                  object.type == DataType::kReal32
                      ? std::int64_t{std::bit_cast<std::uint32_t>(static_cast<float>(temperature_C))}
                      : std::llround(temperature_C / object.unit_C));
}

}  // namespace strainwave::can_nodes
