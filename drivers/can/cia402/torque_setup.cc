// SPDX-License-Identifier: BSD-3-Clause
// The part of a CiA 402 drive's set-up that concerns torque: its unit, its limits, and settings that would change it.
#include "drivers/can/cia402/cia402_objects.h"
#include "drivers/can/cia402/setup_steps.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::cia402 {

namespace {

using canopen::Entry;
using canopen::SdoClient;

constexpr Entry kMaxTorque{0x6072, 0};
constexpr Entry kRatedCurrent_mA{0x6075, 0};
constexpr Entry kPolarity{0x607E, 0};
constexpr Entry kTorqueSlope{0x6087, 0};
constexpr Entry kPositiveTorqueLimit{0x60E0, 0};
constexpr Entry kNegativeTorqueLimit{0x60E1, 0};

/// Sets the limit in the drive as well, in the objects that it has.
void limit_torque(SdoClient& client, std::uint16_t limit_per_mille, DriveMode mode,
                  std::vector<std::string>& report) {
  bool limited = false;
  const auto limit_by = [&](Entry entry, const char* purpose) {
    limited = client.write_if_writable({entry, limit_per_mille, 2, ~0U, purpose}) || limited;
  };
  limit_by(kMaxTorque, "torque limit");
  limit_by(kPositiveTorqueLimit, "positive torque limit");
  limit_by(kNegativeTorqueLimit, "negative torque limit");
  if (!limited)
    report.push_back(client.who() + ": the drive takes none of 6072h, 60E0h and 60E1h: " +
                     (closes_loop(mode) ? "only its own setting limits its torque; set it to "
                                          "joint.limits.torque_limit_Nm in the drive"
                                        : "only this daemon limits the torque"));
}

}  // namespace

void clear_offset(SdoClient& client, Entry entry, std::uint8_t bytes, const char* purpose) {
  if (client.write_if_writable({entry, 0, bytes, ~0U, purpose}) || !client.upload_if_there(entry, bytes))
    return;
  refuse(client, to_text(entry) + " (" + purpose +
                     ") is read-only and not 0, and would be added to each order: set it to 0 in the drive");
}

double configure_torque(SdoClient& client, const DriveConfig& config, std::vector<std::string>& report) {
  const auto current_mA = client.upload_if_there(kRatedCurrent_mA, 4);
  if (!current_mA && config.rated_current_A <= 0.0)
    refuse(client,
           "has no rated current (6075h) to check the unit of its torque with: give motor.rated_current_A");
  const RatedValues rated{number(client, kRatedTorque), current_mA ? static_cast<std::uint32_t>(*current_mA)
                                                                   : thousandths(config.rated_current_A)};
  const double rated_Nm =
      rated_joint_torque_Nm(rated, config.units, client.who() + ": node " + std::to_string(client.node()));
  if (const auto doubt = rated_torque_doubt(rated_Nm, config.units, config.torque_limit_Nm))
    report.push_back(client.who() + ": warning: " + *doubt);
  const TorqueScale scale(rated_Nm, config.units.direction, config.torque_limit_Nm);
  if (scale.limit_per_mille() == 0)
    refuse(client, "torque_limit_Nm = " + std::to_string(config.torque_limit_Nm) +
                       " is less than a thousandth of the rated " + std::to_string(rated_Nm) +
                       " N.m at the joint, which is the drive's step");
  if (config.torque_limit_Nm > rated_Nm * INT16_MAX / 1000.0)
    refuse(client, "torque_limit_Nm = " + std::to_string(config.torque_limit_Nm) +
                       " is more than 32.767 times the rated " + std::to_string(rated_Nm) +
                       " N.m at the joint, which 6071h cannot hold: check both");
  limit_torque(client, scale.limit_per_mille(), config.drive_mode, report);
  return rated_Nm;
}

void configure_torque_path(SdoClient& client, const DriveConfig& config, OperationMode mode,
                           std::vector<std::string>& report) {
  const auto polarity = client.upload_if_there(kPolarity, 1);
  if (polarity.value_or(0) != 0)
    refuse(client, "607Eh (polarity) = " + hexadecimal(*polarity, 2) +
                       " inverts signs in the drive: set it to 0 and store it, and use `direction` instead");
  clear_offset(client, kTorqueOffset, 2, "torque offset");
  if (mode != OperationMode::kTorque || !client.upload_if_there(kTorqueSlope, 4)) return;
  // The slope allows the change from full negative to full positive torque within a period.
  const auto slope = static_cast<std::uint32_t>(std::lround(2.0 * INT16_MAX / config.period_s));
  try {
    client.write_verified({kTorqueSlope, slope, 4, ~0U, "torque slope"});
  } catch (const InputError&) {
    report.push_back(client.who() + ": the drive limits how fast torque changes: 6087h = " +
                     std::to_string(number(client, kTorqueSlope)) + " per mille of rated torque in a second");
  }
}

}  // namespace strainwave::cia402
