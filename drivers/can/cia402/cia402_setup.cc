// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_setup.h"

#include <cmath>
#include <sstream>

#include "base/durations.h"
#include "drivers/can/cia402/cia402_description.h"
#include "drivers/can/cia402/cia402_objects.h"
#include "drivers/can/cia402/cia402_state.h"
#include "drivers/can/cia402/setup_steps.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::cia402 {

namespace {

using canopen::Entry;
using canopen::NmtCommand;
using canopen::SdoClient;
using canopen::SdoWrite;

// Communication profile, CiA 301.
constexpr Entry kSyncIdentifier{0x1005, 0};
constexpr Entry kSyncPeriod_us{0x1006, 0};
constexpr Entry kEmergencyIdentifier{0x1014, 0};
constexpr Entry kConsumerHeartbeat{0x1016, 1};
constexpr Entry kProducerHeartbeat_ms{0x1017, 0};
// Drive profile, CiA 402.
constexpr Entry kAbortConnection{0x6007, 0};
constexpr Entry kErrorCode{0x603F, 0};
constexpr Entry kInterpolationMantissa{0x60C2, 1};
constexpr Entry kInterpolationExponent{0x60C2, 2};

constexpr std::uint32_t kSyncProducerBit = 1U << 30U;

/// Longest SDO answer allowed. Start-up needs about 120 answers, so it takes 13 s at most.
constexpr std::int64_t kSlowestAnswer_ns = 100'000'000;
constexpr std::int64_t kPoll_ns = 5'000'000;
/// Index of the target among the objects of RPDO1.
constexpr std::size_t kTargetPlace = 1;
constexpr std::int64_t kDisableWait_ns = 500'000'000;
/// Two nodes with the same id answer in quick succession.
constexpr std::int64_t kSecondAnswer_ns = 20'000'000;

std::int64_t boot_timeout_ns(const DriveConfig& config) {
  return nanoseconds(config.boot_timeout_s);
}

/// A drive is silent or slow for a while after power-on, and a reset would only make it start again. A drive
/// that stays slow would keep start-up busy for half a minute.
void wait_until_it_answers(SdoClient& client, const DriveConfig& config) {
  const std::int64_t deadline_ns = client.port().now_ns() + boot_timeout_ns(config);
  std::optional<std::int64_t> took_ns;
  do {
    const std::int64_t asked_ns = client.port().now_ns();
    try {
      (void)client.upload(kDeviceType);
      took_ns = client.port().now_ns() - asked_ns;
      if (*took_ns <= kSlowestAnswer_ns) return;
    } catch (const canopen::SdoError& error) {
      if (!error.no_answer()) throw;
    }
  } while (client.port().now_ns() < deadline_ns);
  const std::string within = " within boot_timeout_s = " + std::to_string(config.boot_timeout_s);
  if (took_ns)
    refuse(client, "needs " + std::to_string(*took_ns / 1'000'000) + " ms to answer an SDO, at most " +
                       std::to_string(kSlowestAnswer_ns / 1'000'000) + " ms are allowed" + within +
                       ": check the traffic on the bus, and the drive's settings of its SDO server");
  refuse(client,
         "no answer" + within +
             ": check supply, node_id, bit rate and wiring; `strainwavectl can-scan` lists the nodes");
}

void reset_communication(SdoClient& client, const DriveConfig& config) {
  if (!client.reset_communication(boot_timeout_ns(config)))
    refuse(client, "no boot-up message within boot_timeout_s = " + std::to_string(config.boot_timeout_s) +
                       " after the reset of its communication: it needs longer to start, or did not reset");
}

/// Some drives need time to start; until then their heartbeat would look like a lost network state.
void start_node(SdoClient& client, const DriveConfig& config) {
  client.send_nmt(NmtCommand::kStart);
  if (!client.wait_for_state(canopen::NmtState::kOperational, boot_timeout_ns(config)))
    refuse(client, "no heartbeat shows the state operational within boot_timeout_s = " +
                       std::to_string(config.boot_timeout_s) + " after the order to start the node");
}

void check_identity(SdoClient& client, const Identity& wanted, const Description& found) {
  const auto compare = [&](const char* key, std::optional<std::uint32_t> want, std::uint32_t have) {
    if (want && *want != have)
      refuse(client, std::string(key) + " = " + hexadecimal(*want, 8) + ", but the drive has " +
                         hexadecimal(have, 8) + ": it is not the drive of the configuration (" +
                         to_text(found) + ")");
  };
  compare("vendor_id", wanted.vendor_id, found.vendor_id);
  compare("product_code", wanted.product_code, found.product_code);
  compare("revision_number", wanted.revision_number, found.revision_number);
  compare("serial_number", wanted.serial_number, found.serial_number);
}

// The drive must notice the loss of this daemon and react: nothing else protects the joint then.
void configure_supervision(SdoClient& client, const DriveConfig& config, std::vector<std::string>& report) {
  const std::uint32_t consumer =
      static_cast<std::uint32_t>(config.our_node_id) << 16U | thousandths(config.our_heartbeat_timeout_s);
  const bool hears_heartbeat =
      client.write_if_writable({kConsumerHeartbeat, consumer, 4, ~0U, "supervision of our heartbeat"});
  const bool has_deadline = configure_deadline(client, config);
  if (!hears_heartbeat && !has_deadline)
    refuse(
        client,
        "takes neither 1016h (supervision of our heartbeat) nor 1400h:05 (deadline of RPDO1): nothing would "
        "stop it when this daemon dies, and the daemon refuses to drive it");
  if (!has_deadline)
    report.push_back(
        client.who() +
        ": the drive has no deadline of RPDO1 (1400h:05): it notices the loss of this daemon " +
        std::to_string(thousandths(config.our_heartbeat_timeout_s)) +
        " ms after the last heartbeat, and not at all while another node sends the same heartbeat");
  if (!hears_heartbeat)
    report.push_back(client.who() +
                     ": the drive does not take 1016h: it notices the loss of this daemon only by the "
                     "deadline of RPDO1 (1400h:05)");
  const std::uint32_t heartbeat_ms = thousandths(config.drive_heartbeat_s);
  if (!client.write_if_writable({kProducerHeartbeat_ms, heartbeat_ms, 2, ~0U, "the drive's heartbeat"}))
    refuse(client, "does not take a heartbeat period of " + std::to_string(heartbeat_ms) +
                       " ms (1017h): set drive_heartbeat_s to its own; without a heartbeat it is refused");
  if (!client.write_if_writable({kAbortConnection, static_cast<std::uint16_t>(config.abort_connection), 2,
                                 ~0U, "reaction to a lost connection"}))
    report.push_back(
        client.who() +
        ": the drive does not take 6007h: it decides by itself what it does without our heartbeat. Before "
        "use, kill the daemon while the unloaded joint moves slowly, and check that it stops");
  if (config.quick_stop_option)
    client.write_verified({kQuickStopOption, static_cast<std::uint16_t>(*config.quick_stop_option), 2, ~0U,
                           "reaction to a quick stop"});
  const std::uint32_t wanted = canopen::cob_id(canopen::CobId::kEmergency, client.node());
  const auto emergency = client.upload_if_there(kEmergencyIdentifier, 4);
  if (emergency && *emergency != wanted)
    client.write_verified({kEmergencyIdentifier, wanted, 4, ~0U, "identifier of emergency messages"});
}

/// Writes the period; 60C2h takes it as a one-byte number and a power of ten of seconds.
void configure_period(SdoClient& client, const DriveConfig& config) {
  const auto period_us = static_cast<std::uint32_t>(std::lround(config.period_s * 1e6));
  (void)client.write_if_writable({kSyncPeriod_us, period_us, 4, ~0U, "SYNC period"});
  if (config.produces_sync) {
    const std::uint32_t sync = canopen::cob_id(canopen::CobId::kSync);
    client.write_verified({kSyncIdentifier, sync | kSyncProducerBit, 4, ~0U, "production of SYNC"});
  }
  if (!client.upload_if_there(kInterpolationMantissa, 1)) return;
  std::uint32_t mantissa = period_us;
  int exponent = -6;
  for (; mantissa % 10 == 0 && exponent < 0; ++exponent) mantissa /= 10;
  if (mantissa > UINT8_MAX)
    refuse(client, "a period of " + std::to_string(period_us) +
                       " us cannot be written to 60C2h: choose a rounder period_s");
  client.write_verified({kInterpolationMantissa, mantissa, 1, ~0U, "interpolation period"});
  client.write_verified({kInterpolationExponent, static_cast<std::uint8_t>(exponent), 1, ~0U,
                         "unit of the interpolation period"});
}

/// Removes the torque whatever the drive did before: another daemon may have died while the drive was enabled.
void take_torque_off(SdoClient& client, const DriveConfig& config) {
  if (!closes_loop(config.drive_mode)) client.download(kTargetTorque, 0, 2);
  client.download(kControlword, controlword::kDisableVoltage, 2);
  const std::int64_t deadline_ns = client.port().now_ns() + kDisableWait_ns;
  const auto has_torque = [&] {
    const PowerState state = power_state_of(static_cast<std::uint16_t>(number(client, kStatusword, 2)));
    return state == PowerState::kOperationEnabled || state == PowerState::kQuickStopActive ||
           state == PowerState::kFaultReaction;
  };
  while (has_torque()) {
    if (client.port().now_ns() >= deadline_ns)
      refuse(client, "stays enabled after the order to disable voltage");
    (void)client.port().wait(kPoll_ns);
  }
}

void report_found(Found& found, const Description& description, const DriveConfig& config) {
  std::ostringstream text;
  text << config.name << ": node " << static_cast<int>(config.node_id) << ", " << to_text(description)
       << ", mode " << static_cast<int>(found.mode) << " (" << to_text(found.mode) << ")";
  if (found.rated_torque_Nm > 0.0)
    text << ", rated " << found.rated_torque_Nm << " N.m at the joint, limit " << config.torque_limit_Nm
         << " N.m";
  found.report.push_back(text.str());
  // If the configuration names the vendor, its reader has already given this warning.
  if (const auto doubt = torque_unit_doubt(description.vendor_id, config.units);
      doubt && !config.identity.vendor_id)
    found.report.push_back(config.name + ": warning: rated_torque_unit: " + *doubt);
  if (power_state_of(found.statusword) == PowerState::kFault)
    found.report.push_back(config.name + ": the drive is in fault, " +
                           canopen::drive_error_text(found.error_code) +
                           "; enable shows it, clear-fault resets it");
}

}  // namespace

Description identify_drive(SdoClient& client, const DriveConfig& config) {
  wait_until_it_answers(client, config);
  Description description = describe(client);
  if (!is_servo_drive(description))
    refuse(client, "is not a CiA 402 drive: device type 1000h = " + hexadecimal(description.device_type, 8) +
                       ", the profile must be 0192h");
  check_identity(client, config.identity, description);
  if (client.two_answer(kDeviceType, kSecondAnswer_ns))
    refuse(client, "two nodes answer with this id: give each drive on the bus an id of its own");
  return description;
}

Found set_up_drive(SdoClient& client, const DriveConfig& config, PdoLayout& layout,
                   const Description& description) {
  Found found;
  std::optional<OperationMode> named;
  if (description.supported_modes)
    named = choose_mode(client, config.drive_mode, description.supported_modes);
  reset_communication(client, config);
  take_torque_off(client, config);
  found.mode = named ? *named : choose_mode(client, config.drive_mode, {});
  // Restores the entry as well, in case a repeated start-up finds another drive.
  if (config.drive_mode == DriveMode::kPosition)
    layout.command.objects[kTargetPlace].entry =
        found.mode == OperationMode::kInterpolatedPosition ? kInterpolatedTarget : kTargetPosition;
  const bool knows_torque = !closes_loop(config.drive_mode) || client.upload_if_there(kRatedTorque, 4);
  if (!knows_torque) {
    leave_out(layout.command, layout.torque_offset);
    leave_out(layout.fast, layout.torque);
    found.report.push_back(
        client.who() +
        ": the drive has no 6076h: the daemon sends it no torque and learns nothing of its friction, "
        "and the drive limits its torque by itself");
  }
  configure_pdos(client, config, layout, found.report);
  if (config.inputs.index != ProbeSource::kNone)
    client.write_verified({kProbeFunction, 0, 2, ~0U, "touch probe off"});
  configure_supervision(client, config, found.report);
  if (knows_torque) found.rated_torque_Nm = configure_torque(client, config, found.report);
  configure_torque_path(client, config, found.mode, found.report);
  if (config.units.velocity_rad_s_per_unit != 0.0) {
    const auto unit = static_cast<std::uint32_t>(client.upload_if_there(kVelocityUnit, 4).value_or(0));
    found.report.push_back(velocity_unit_text(unit, config.units, client.who()));
  }
  if (closes_loop(config.drive_mode)) configure_own_loop(client, config, found.report);
  configure_period(client, config);
  set_mode(client, found.mode);
  found.statusword = static_cast<std::uint16_t>(number(client, kStatusword, 2));
  if (power_state_of(found.statusword) == PowerState::kFault)
    found.error_code = static_cast<std::uint16_t>(client.upload_if_there(kErrorCode, 2).value_or(0));
  report_found(found, description, config);
  start_node(client, config);
  return found;
}

void release_drive(SdoClient& client, const DriveConfig& config) {
  take_torque_off(client, config);
  (void)client.write_if_writable({kConsumerHeartbeat, 0, 4, ~0U, "no supervision of our heartbeat"});
}

}  // namespace strainwave::cia402
