// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_config.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/input_error.h"
#include "drivers/can/cia402/cia402_objects.h"

namespace strainwave::cia402 {

namespace {

using canopen::MappedObject;
using canopen::Pdo;
using canopen::PdoDirection;

constexpr MappedObject kMappedControlword{kControlword, 2};
constexpr MappedObject kMappedStatusword{kStatusword, 2};
constexpr MappedObject kMappedModeDisplay{kModeDisplay, 1};
constexpr MappedObject kPosition{{0x6064, 0}, 4};
constexpr MappedObject kVelocity{{0x606C, 0}, 4};
constexpr MappedObject kMappedTargetTorque{kTargetTorque, 2};
constexpr MappedObject kMappedTargetPosition{kTargetPosition, 4};
constexpr MappedObject kMappedTargetVelocity{kTargetVelocity, 4};
constexpr MappedObject kMappedTorqueOffset{kTorqueOffset, 2};
constexpr MappedObject kMappedVelocityOffset{kVelocityOffset, 4};
constexpr MappedObject kTorque{{0x6077, 0}, 2};
constexpr MappedObject kDigitalInputs{{0x60FD, 0}, 4};
constexpr MappedObject kMappedProbeFunction{kProbeFunction, 2};
constexpr MappedObject kProbeStatus{{0x60B9, 0}, 2};
constexpr MappedObject kProbePosition{{0x60BA, 0}, 4};

constexpr std::uint8_t kEverySync = 1;
constexpr int kMaxSyncDivider = 240;

/// Maps `object` into `pdo` if there is room for it.
PdoLayout::Field map(Pdo& pdo, const MappedObject& object) {
  const std::size_t offset = pdo.bytes();
  if (offset + object.bytes > kMaxCanBytes) return {};
  pdo.objects.push_back(object);
  return {pdo.number, offset, object.bytes};
}

const MappedObject& target_of(DriveMode mode) {
  return mode == DriveMode::kTorque     ? kMappedTargetTorque
         : mode == DriveMode::kPosition ? kMappedTargetPosition
                                        : kMappedTargetVelocity;
}

/// The torque offset fills RPDO1 of a drive that closes its own loop, so further orders go to RPDO2.
void map_orders(const DriveConfig& config, PdoLayout& layout) {
  layout.command = {PdoDirection::kReceive, 1, kEverySync, {kMappedControlword}};
  layout.offsets = {PdoDirection::kReceive, 2, kEverySync, {}};
  layout.target = map(layout.command, target_of(config.drive_mode));
  if (closes_loop(config.drive_mode)) layout.torque_offset = map(layout.command, kMappedTorqueOffset);
  if (config.inputs.index != ProbeSource::kNone)
    layout.probe_function =
        map(closes_loop(config.drive_mode) ? layout.offsets : layout.command, kMappedProbeFunction);
  if (config.drive_mode == DriveMode::kPosition && config.units.velocity_rad_s_per_unit != 0.0)
    layout.velocity_offset = map(layout.offsets, kMappedVelocityOffset);
}

std::uint8_t sync_divider(const DriveConfig& config) {
  double period_s = config.status_period_s;
  if (config.temperature && config.temperature->way == TemperatureObject::Way::kPdo &&
      !config.uses_drive_velocity())
    period_s = std::min(period_s, config.temperature->period_s);
  return static_cast<std::uint8_t>(
      std::clamp(std::lround(period_s / config.period_s), 1L, long{kMaxSyncDivider}));
}

}  // namespace

double temperature_C(const TemperatureObject& object, std::uint64_t raw) noexcept {
  double value = 0.0;
  switch (object.type) {
    case NumberType::kInt8:
      value = static_cast<std::int8_t>(raw);
      break;
    case NumberType::kUint8:
      value = static_cast<std::uint8_t>(raw);
      break;
    case NumberType::kInt16:
      value = static_cast<std::int16_t>(raw);
      break;
    case NumberType::kUint16:
      value = static_cast<std::uint16_t>(raw);
      break;
    case NumberType::kInt32:
      value = static_cast<std::int32_t>(raw);
      break;
    case NumberType::kUint32:
      value = static_cast<std::uint32_t>(raw);
      break;
    case NumberType::kReal32:
      value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
      break;
  }
  return value * object.scale_C + object.offset_C;
}

PdoLayout pdo_layout(const DriveConfig& config) {
  PdoLayout layout;
  map_orders(config, layout);
  layout.fast = {PdoDirection::kTransmit, 1, kEverySync, {}};
  layout.slow = {PdoDirection::kTransmit, 2, sync_divider(config), {}};
  layout.position = map(layout.fast, kPosition);
  if (config.uses_drive_velocity()) layout.velocity = map(layout.fast, kVelocity);
  Pdo& status = config.uses_drive_velocity() ? layout.slow : layout.fast;
  layout.statusword = map(status, kMappedStatusword);
  layout.torque = map(status, kTorque);
  if (config.inputs.any()) layout.inputs = map(layout.slow, kDigitalInputs);
  if (config.temperature && config.temperature->way == TemperatureObject::Way::kPdo) {
    layout.temperature = map(layout.slow, {config.temperature->entry, bytes_of(config.temperature->type)});
    if (layout.temperature.pdo == 0)
      throw InputError(config.name +
                       ": TPDO2 has no room for the temperature beside the inputs: set "
                       "joint.can.temperature.way = \"sdo\"");
  }
  layout.mode = map(layout.slow, kMappedModeDisplay);
  layout.probe = {PdoDirection::kTransmit, 3, sync_divider(config), {}};
  if (config.inputs.index != ProbeSource::kNone) {
    layout.probe_status = map(layout.probe, kProbeStatus);
    layout.probe_position = map(layout.probe, kProbePosition);
  }
  return layout;
}

}  // namespace strainwave::cia402
