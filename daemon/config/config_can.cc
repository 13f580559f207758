// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_can.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/units.h"
#include "daemon/config/config_doubts.h"
#include "daemon/config/config_drive_mode.h"
#include "daemon/config/config_encoder.h"
#include "daemon/config/config_motor.h"
#include "daemon/config/config_odrive.h"
#include "daemon/config/drive_doubts.h"
#include "drivers/can/cia402/cia402_node.h"

namespace strainwave {

namespace {

constexpr std::int64_t kMaxNodeId = 127;
constexpr std::int64_t kMaxObject = 0xFFFF;
constexpr std::int64_t kMaxSubIndex = 0xFF;
/// Default: 4 kHz, between the 8 kHz and the 2.5 kHz of usual drives. At 8 kHz it is no worse than 0 (strainwave-sim own-loop).
constexpr double kUsualDriveLoop_s = 0.00025;
/// Objects 1016h and 1017h hold milliseconds; 1017h has 16 bits.
constexpr Range kHeartbeat_s{0.001, 60.0};

cia402::Identity read_identity(TomlSection section) {
  constexpr std::int64_t kNotGiven = -1;
  const auto number = [](std::int64_t value) {
    return value == kNotGiven ? std::nullopt : std::optional(static_cast<std::uint32_t>(value));
  };
  cia402::Identity identity;
  identity.vendor_id = number(section.integer_or("vendor_id", kNotGiven, 0, UINT32_MAX));
  identity.product_code = number(section.integer_or("product_code", kNotGiven, 0, UINT32_MAX));
  identity.revision_number = number(section.integer_or("revision_number", kNotGiven, 0, UINT32_MAX));
  identity.serial_number = number(section.integer_or("serial_number", kNotGiven, 0, UINT32_MAX));
  section.refuse_unknown_keys();
  return identity;
}

cia402::NumberType number_type(const std::string& name) {
  using Type = cia402::NumberType;
  const std::pair<const char*, Type> types[]{
      {"int8", Type::kInt8},   {"uint8", Type::kUint8},   {"int16", Type::kInt16},  {"uint16", Type::kUint16},
      {"int32", Type::kInt32}, {"uint32", Type::kUint32}, {"real32", Type::kReal32}};
  for (const auto& [text, type] : types)
    if (name == text) return type;
  return Type::kInt16;
}

cia402::TemperatureObject read_temperature(TomlSection section, double period_s) {
  cia402::TemperatureObject object;
  object.entry.index = static_cast<std::uint16_t>(section.integer("index", 0x1000, kMaxObject));
  object.entry.sub_index = static_cast<std::uint8_t>(section.integer_or("sub_index", 0, 0, kMaxSubIndex));
  object.type =
      number_type(section.choice("type", {"int8", "uint8", "int16", "uint16", "int32", "uint32", "real32"}));
  object.scale_C = section.number("scale_C", {-1e6, 1e6});
  if (object.scale_C == 0.0) section.fail("scale_C", "a number other than 0 is allowed");
  object.offset_C = section.number_or("offset_C", 0.0, {-1000.0, 1000.0});
  object.way = section.choice_or("way", "sdo", {"sdo", "pdo"}) == "pdo"
                   ? cia402::TemperatureObject::Way::kPdo
                   : cia402::TemperatureObject::Way::kSdo;
  object.period_s = section.number_or("period_s", 1.0, {std::max(0.01, period_s), 60.0});
  section.refuse_unknown_keys();
  return object;
}

MotorLimits read_motor(TomlSection section, const JointConfig& joint, cia402::DriveConfig& drive) {
  const MotorConstants motor = read_motor_constants(section);
  drive.units.torque_constant_Nm_A = motor.torque_constant_Nm_A;
  drive.rated_current_A = section.number_or("rated_current_A", 0.0, {0.0, 1e4});
  const MotorLimits limits = read_motor_limits(section, motor, drive.units.gear_ratio, drive.torque_limit_Nm);
  doubt_motor(section, joint, drive);
  section.refuse_unknown_keys();
  return limits;
}

cia402::DriveInputs read_inputs(TomlSection section) {
  cia402::DriveInputs inputs;
  inputs.negative_limit = section.boolean_or("negative_limit", false);
  inputs.positive_limit = section.boolean_or("positive_limit", false);
  inputs.home = section.boolean_or("home", false);
  const std::string index = section.choice_or("index", "none", {"none", "encoder", "probe"});
  inputs.index = index == "encoder" ? cia402::ProbeSource::kIndex
                 : index == "probe" ? cia402::ProbeSource::kInput
                                    : cia402::ProbeSource::kNone;
  section.refuse_unknown_keys();
  return inputs;
}

void read_units(TomlSection& section, const JointConfig& joint, cia402::UnitConfig& units) {
  units.counts_per_output_revolution = section.number("counts_per_output_revolution", {1.0, 1e10});
  units.direction = section.choice_or("direction", "same", {"same", "reversed"}) == "same" ? 1 : -1;
  units.position_offset_rad = section.number_or("position_offset_rad", 0.0, {-1e3, 1e3});
  doubt_angle(section, "position_offset_rad", units.position_offset_rad);
  units.velocity_rad_s_per_unit = section.number_or("velocity_rad_s_per_unit", 0.0, {0.0, 1e3});
  units.rated_torque_unit_Nm = section.choice("rated_torque_unit", {"mNm", "uNm"}) == "mNm" ? 1e-3 : 1e-6;
  units.torque_at_joint = section.choice("torque_side", {"motor", "joint"}) == "joint";
  units.gear_ratio = joint.plant.gear_ratio;
}

void read_supervision(TomlSection& section, cia402::DriveConfig& drive) {
  drive.drive_heartbeat_s = section.number_or("drive_heartbeat_s", drive.drive_heartbeat_s, kHeartbeat_s);
  drive.drive_heartbeat_timeout_s = section.number_or(
      "drive_heartbeat_timeout_s", 3.0 * drive.drive_heartbeat_s, {drive.drive_heartbeat_s, 60.0});
  const std::string abort =
      section.choice_or("abort_connection", "quick_stop", {"fault", "disable_voltage", "quick_stop"});
  drive.abort_connection = abort == "fault"             ? cia402::AbortConnection::kFault
                           : abort == "disable_voltage" ? cia402::AbortConnection::kDisableVoltage
                                                        : cia402::AbortConnection::kQuickStop;
  if (section.has("quick_stop_option"))
    drive.quick_stop_option =
        static_cast<std::int16_t>(section.integer_or("quick_stop_option", 2, -32768, 32767));
  drive.zero_torque_after =
      static_cast<int>(section.integer_or("zero_torque_after", drive.zero_torque_after, 0, 100));
  const int stop_after = std::max(drive.quick_stop_after, drive.zero_torque_after);
  drive.quick_stop_after =
      static_cast<int>(section.integer_or("quick_stop_after", stop_after, drive.zero_torque_after, 1000));
  drive.quick_stop_timeout_s =
      section.number_or("quick_stop_timeout_s", drive.quick_stop_timeout_s, {0.0, 60.0});
  drive.following_bit = section.boolean_or("following_bit", drive.following_bit);
  drive.step_timeout_s = section.number_or("step_timeout_s", drive.step_timeout_s, {0.01, 60.0});
  drive.boot_timeout_s = section.number_or("boot_timeout_s", drive.boot_timeout_s, {0.1, 60.0});
  drive.status_period_s = section.number_or("status_period_s", drive.status_period_s, {drive.period_s, 1.0});
}

}  // namespace

CanConfig::CanConfig(TomlSection& root, double period_s, double stall_s)
    : period_s_(period_s), stall_s_(stall_s) {
  if (!root.has("can_bus")) return;
  for (TomlSection& section : root.sections("can_bus")) {
    Bus bus{section.text("name"), section, {}, false, {}, {}, false};
    bus.config.interface_name = bus.section.text("interface");
    bus.config.bit_rate =
        static_cast<std::uint32_t>(bus.section.integer_or("bit_rate", 1'000'000, 10'000, 1'000'000));
    bus.config.load_limit = bus.section.number_or("load_limit", bus.config.load_limit, {0.01, 1.0});
    const std::string sync = bus.section.choice_or("sync", "daemon", {"daemon", "drive", "other", "none"});
    bus.config.sync = sync == "daemon" ? SyncProducer::kDaemon
                      : sync == "none" ? SyncProducer::kNone
                                       : SyncProducer::kOther;
    bus.drive_makes_sync = sync == "drive";
    bus.config.our_node_id = static_cast<std::uint8_t>(
        bus.section.integer_or("our_node_id", bus.config.our_node_id, 1, kMaxNodeId));
    if (bus.config.sync != SyncProducer::kNone)
      bus.config.heartbeat_period_s = bus.section.number_or("heartbeat_s", 0.05, kHeartbeat_s);
    else if (bus.section.has("heartbeat_s"))
      bus.section.fail("heartbeat_s",
                       "the daemon sends no heartbeat on a bus with sync = \"none\": leave the key out");
    bus.config.stuck_periods =
        static_cast<int>(bus.section.integer_or("stuck_periods", bus.config.stuck_periods, 1, 1000));
    bus.config.period_s = period_s;
    bus.section.refuse_unknown_keys();
    for (const Bus& other : buses_) {
      if (other.name == bus.name) bus.section.fail("name", "each bus needs a name of its own");
      if (other.config.interface_name == bus.config.interface_name)
        bus.section.fail("interface", "each bus needs an interface of its own");
    }
    buses_.push_back(std::move(bus));
  }
}

CanConfig::Bus& CanConfig::find_bus(TomlSection& section) {
  const std::string name = section.text("bus");
  const auto found =
      std::find_if(buses_.begin(), buses_.end(), [&](const Bus& bus) { return bus.name == name; });
  if (found == buses_.end()) section.fail("bus", "the name of a [[can_bus]] is allowed");
  return *found;
}

HomingInputs CanConfig::read_joint(TomlSection& section, JointConfig& joint) {
  Bus& bus = find_bus(section);
  const bool is_odrive = section.choice("protocol", {"cia402", "odrive"}) == "odrive";
  const auto node_id = static_cast<int>(is_odrive ? section.integer("node_id", 0, odrive::kMaxNodeId)
                                                  : section.integer("node_id", 1, kMaxNodeId));
  if (std::find(bus.node_ids.begin(), bus.node_ids.end(), node_id) != bus.node_ids.end())
    section.note_error(section.place("node_id") + ": each drive on a bus needs a node id of its own");
  if (!is_odrive && node_id == bus.config.our_node_id)
    section.note_error(section.place("node_id") + ": any but the bus's our_node_id is allowed");
  joint.drive = DriveOnBus{static_cast<std::size_t>(&bus - buses_.data()), bus.drives.size()};
  joint.driver_resource = bus.config.interface_name + " node " + std::to_string(node_id);
  bus.node_ids.push_back(node_id);
  // The identifiers of the two protocols overlap, so a bus has only one protocol. CiA 402 needs a SYNC, CANSimple has none.
  if (is_odrive) {
    if (bus.config.sync != SyncProducer::kNone)
      section.fail("protocol", "ODrives need a bus of their own: set can_bus.sync to \"none\"");
    const odrive::DriveConfig drive = read_odrive(section, node_id, period_s_, joint);
    bus.drives.emplace_back(drive);
    HomingInputs inputs;
    inputs.counts_from_switch_on = !drive.absolute_encoder;
    return inputs;
  }
  return read_cia402(section, bus, node_id, joint);
}

HomingInputs CanConfig::read_cia402(TomlSection& section, Bus& bus, int node_id, JointConfig& joint) {
  if (bus.config.sync == SyncProducer::kNone)
    section.fail("protocol",
                 "\"cia402\" needs a bus with SYNC: set can_bus.sync to \"daemon\", \"drive\" or \"other\"");
  cia402::DriveConfig drive;
  drive.name = joint.name;
  drive.node_id = static_cast<std::uint8_t>(node_id);
  drive.our_node_id = bus.config.our_node_id;
  drive.period_s = period_s_;
  drive.torque_limit_Nm = joint.loop.controller.torque_limit_Nm;
  drive.following_error_rad = joint.loop.limits.following_error_rad;
  drive.daemon_sends_sync = bus.config.sync == SyncProducer::kDaemon;
  drive.produces_sync = section.boolean_or("produces_sync", false);
  if (drive.produces_sync && (!bus.drive_makes_sync || bus.has_sync_drive))
    section.fail("produces_sync", "true is allowed for one drive of a bus with sync = \"drive\"");
  bus.has_sync_drive = bus.has_sync_drive || drive.produces_sync;
  drive.our_heartbeat_timeout_s = section.number_or(
      "our_heartbeat_timeout_s", 3.0 * bus.config.heartbeat_period_s, {bus.config.heartbeat_period_s, 60.0});
  // A longer absence of the loop is a fault. The object 1400h:05 holds milliseconds, at most 65535.
  drive.command_deadline_s = std::clamp(std::ceil(stall_s_ * 1e3) * 1e-3, 1e-3, 65.0);
  drive.identity = read_identity(section.section_or_empty("identity"));
  read_units(section, joint, drive.units);
  read_encoder_side(section, joint.loop.controller);
  drive.drive_mode = read_drive_mode(section, joint);
  if (drive.drive_mode == DriveMode::kVelocity && drive.units.velocity_rad_s_per_unit == 0.0)
    section.fail("drive_mode", "\"velocity\" needs velocity_rad_s_per_unit, the unit of 60FFh at the joint");
  if (drive.drive_mode == DriveMode::kPosition)
    joint.loop.controller.drive_loop_period_s =
        section.number_or("drive_loop_period_s", std::min(kUsualDriveLoop_s, period_s_), {0.0, period_s_});
  else if (section.has("drive_loop_period_s"))
    section.fail("drive_loop_period_s", "it is allowed only with drive_mode = \"position\"");
  drive.absolute_encoder = section.choice("encoder", {"absolute", "incremental"}) == "absolute";
  drive.inputs = read_inputs(section.section_or_empty("inputs"));
  read_supervision(section, drive);
  if (section.has("temperature"))
    drive.temperature = read_temperature(section.section("temperature"), period_s_);

  JointControllerConfig& controller = joint.loop.controller;
  controller.motor = read_motor(section.section("motor"), joint, drive);
  doubt_drive(section, joint, drive);
  controller.encoder_resolution_rad = kTurn_rad / drive.units.counts_per_output_revolution;
  // The drive samples its position at the last SYNC, and an order acts from the next SYNC on: one period of dead time.
  controller.delay_periods = static_cast<int>(section.integer_or("delay_periods", 1, 1, kMaxControlDelay));
  drive.delay_periods = controller.delay_periods;
  joint.drive_error_text = [](Fault /*fault*/, std::uint32_t drive_error) {
    return cia402::drive_error_text(drive_error);
  };
  (void)cia402::pdo_layout(drive);  // throws if the objects do not fit
  bus.drives.emplace_back(drive);
  return {drive.inputs.home, drive.inputs.negative_limit, drive.inputs.positive_limit,
          drive.inputs.index != cia402::ProbeSource::kNone, !drive.absolute_encoder};
}

std::vector<BusConfig> CanConfig::buses() const {
  std::vector<BusConfig> result;
  for (const Bus& bus : buses_) {
    if (bus.drives.empty()) bus.section.fail("name", "each bus needs at least one joint");
    if (bus.drive_makes_sync && !bus.has_sync_drive)
      bus.section.fail("sync", "\"drive\" needs a joint with produces_sync = true");
    require_bus_load(bus.name, CanBus::traffic_of(bus.config, make_nodes(bus.drives)), bus.config.bit_rate,
                     bus.config.load_limit);
    result.push_back({bus.name, bus.config, bus.drives});
  }
  return result;
}

}  // namespace strainwave
