// SPDX-License-Identifier: BSD-3-Clause
// The part of cia402_node.h that runs outside the loop.
#include "drivers/can/cia402/cia402_node.h"

#include <sstream>

#include "base/durations.h"
#include "base/input_error.h"
#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_objects.h"
#include "drivers/can/cia402/cia402_setup.h"

namespace strainwave::cia402 {

namespace {

using canopen::CobId;

/// Equal to the default interval of a temperature.
constexpr double kModePeriod_s = 1.0;

PowerTimes times_of(const DriveConfig& config) noexcept {
  PowerTimes times;
  times.step_ns = nanoseconds(config.step_timeout_s);
  times.quick_stop_ns = nanoseconds(config.quick_stop_timeout_s);
  return times;
}

}  // namespace

Node::Node(const DriveConfig& config)
    : config_(config),
      layout_(pdo_layout(config)),
      step_timeout_ns_(nanoseconds(config.step_timeout_s)),
      period_ns_(nanoseconds(config.period_s)),
      power_(times_of(config)),
      position_scale_(config.units),
      probe_(config.inputs.index),
      watch_(nanoseconds(config.drive_heartbeat_timeout_s)),
      age_(period_ns_, layout_.slow.transmission_type),
      last_resort_(config.node_id) {}

std::vector<std::uint32_t> Node::receive_ids() const {
  std::vector<std::uint32_t> ids{layout_.fast.cob_id(config_.node_id),
                                 cob_id(CobId::kEmergency, config_.node_id),
                                 cob_id(CobId::kHeartbeat, config_.node_id)};
  for (const canopen::Pdo* pdo : {&layout_.slow, &layout_.probe})
    if (!pdo->objects.empty()) ids.push_back(pdo->cob_id(config_.node_id));
  return ids;
}

std::vector<std::uint32_t> Node::transmit_ids() const {
  std::vector<std::uint32_t> ids{layout_.command.cob_id(config_.node_id)};
  if (!layout_.offsets.objects.empty()) ids.push_back(layout_.offsets.cob_id(config_.node_id));
  return ids;
}

std::vector<std::uint32_t> Node::setup_ids() const {
  return {cob_id(CobId::kSdoAnswer, config_.node_id), cob_id(CobId::kHeartbeat, config_.node_id)};
}

std::vector<FrameTraffic> Node::traffic() const {
  const double rate_Hz = 1.0 / config_.period_s;
  const auto bytes = [](const canopen::Pdo& pdo) { return static_cast<int>(pdo.bytes()); };
  std::vector<FrameTraffic> traffic{{"RPDO1 of " + config_.name, bytes(layout_.command), rate_Hz},
                                    {"TPDO1 of " + config_.name, bytes(layout_.fast), rate_Hz},
                                    {"heartbeat of " + config_.name, 1, 1.0 / config_.drive_heartbeat_s}};
  if (!layout_.offsets.objects.empty())
    traffic.push_back({"RPDO2 of " + config_.name, bytes(layout_.offsets), rate_Hz});
  for (const canopen::Pdo* pdo : {&layout_.slow, &layout_.probe})
    if (!pdo->objects.empty())
      traffic.push_back({"TPDO" + std::to_string(pdo->number) + " of " + config_.name, bytes(*pdo),
                         rate_Hz / pdo->transmission_type});
  if (reads_temperature())
    traffic.push_back({"temperature SDO of " + config_.name, static_cast<int>(kMaxCanBytes),
                       2.0 / config_.temperature->period_s});
  return traffic;
}

std::vector<std::string> Node::set_up(CanPort& port) {
  canopen::SdoClient client(port, config_.node_id, config_.name);
  identified_ = false;
  const Description description = identify_drive(client, config_);
  identified_ = true;
  const Found found = set_up_drive(client, config_, layout_, description);
  mode_ = found.mode;
  if (found.rated_torque_Nm > 0.0)
    torque_scale_ = TorqueScale(found.rated_torque_Nm, config_.units.direction, config_.torque_limit_Nm);
  initial_error_ = found.error_code;
  sdo_mode_.put(static_cast<std::uint8_t>(found.mode));
  setup_.end(true);
  return found.report;
}

std::vector<std::string> Node::verify(CanPort& port) {
  verify_drive(port, config_, layout_);
  if (!config_.daemon_sends_sync) return {};
  sync_to_position_ns_ = measure_position_delay_ns(port, config_, layout_);
  std::ostringstream text;
  text << config_.name << ": a position comes " << static_cast<double>(sync_to_position_ns_) * 1e-6
       << " ms after its SYNC";
  return {text.str()};
}

std::vector<std::string> Node::serve(CanPort& port) {
  std::vector<std::string> messages;
  if (setup_.begin()) {
    try {
      messages = set_up(port);
      messages.push_back(config_.name + ": set up again");
    } catch (const InputError& error) {
      messages.emplace_back(error.what());
      setup_.end(false);
    }
  }
  if ((reads_temperature() || reads_mode()) && setup_.now() == SetUpState::State::kReady)
    read_by_sdo(port, messages);
  return messages;
}

void Node::read_by_sdo(CanPort& port, std::vector<std::string>& messages) {
  const std::int64_t now_ns = port.now_ns();
  if (now_ns < sdo_due_ns_) return;
  sdo_due_ns_ = now_ns + nanoseconds(reads_temperature() ? config_.temperature->period_s : kModePeriod_s);
  try {
    canopen::SdoClient client(port, config_.node_id, config_.name);
    if (reads_mode()) sdo_mode_.put(static_cast<std::uint8_t>(client.upload_number(kModeDisplay, 1)));
    if (reads_temperature()) {
      const TemperatureObject& object = *config_.temperature;
      sdo_temperature_.put(
          {temperature_C(object, client.upload_number(object.entry, bytes_of(object.type))), now_ns});
    }
    if (sdo_failed_) messages.push_back(config_.name + ": reading by SDO works again");
    sdo_failed_ = false;
  } catch (const InputError& error) {
    if (!sdo_failed_) messages.emplace_back(error.what());
    sdo_failed_ = true;
  }
}

void Node::end_operation(CanPort& port) noexcept {
  if (identified_)
    (void)port.send(canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, config_.node_id));
}

void Node::shut_down(CanPort& port) noexcept {
  // A drive that was not identified is left unchanged.
  if (!identified_) return;
  try {
    canopen::SdoClient client(port, config_.node_id, config_.name);
    release_drive(client, config_);
  } catch (const std::exception&) {
    // If the drive cannot be reached, its supervision of our heartbeat disables it.
  }
}

}  // namespace strainwave::cia402
