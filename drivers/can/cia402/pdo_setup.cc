// SPDX-License-Identifier: BSD-3-Clause
// The part of a CiA 402 drive's set-up that concerns process data: the used PDOs, their deadline, and switching off the others.
#include "drivers/can/cia402/cia402_objects.h"
#include "drivers/can/cia402/setup_steps.h"

namespace strainwave::cia402 {

namespace {

using canopen::Entry;
using canopen::Pdo;
using canopen::PdoDirection;
using canopen::SdoClient;
using canopen::SdoError;
using canopen::SdoWrite;

/// CANopen allows 512 PDOs in each direction; only the first four have predefined identifiers.
constexpr int kMostPdos = 512;
constexpr int kUsualPdos = 4;
constexpr Entry kCommandDeadline_ms{0x1400, 5};

/// Returns false when the identifier is read-only; it must then be ours. Such a drive lets its mapping change while the PDO is valid.
bool switch_off(SdoClient& client, const Pdo& pdo, const SdoWrite& off, std::uint32_t old_identifier) {
  try {
    client.write_verified(off);
    return true;
  } catch (const SdoError& error) {
    const bool ours = (old_identifier & (canopen::kPdoInvalid | kMaxCanId)) == pdo.cob_id(client.node());
    if (!error.read_only() || !ours) throw;
    return false;
  }
}

bool is_mapped_as_wanted(SdoClient& client, const Pdo& pdo) {
  if (client.upload_number(pdo.mapping(0), 1) != pdo.objects.size()) return false;
  for (std::size_t i = 0; i < pdo.objects.size(); ++i)
    if (client.upload_number(pdo.mapping(static_cast<std::uint8_t>(i + 1)), 4) !=
        mapping_word(pdo.objects[i]))
      return false;
  return true;
}

bool is_mapping(Entry entry) {
  return entry.index >= 0x1600 && (entry.index < 0x1800 || entry.index >= 0x1A00);
}

/// A drive with a fixed mapping is accepted when that mapping is the wanted one.
void configure_pdo(SdoClient& client, const Pdo& pdo) {
  const std::uint32_t old_identifier = number(client, pdo.communication(1));
  std::vector<SdoWrite> writes = canopen::pdo_configuration(pdo, client.node(), old_identifier);
  if (!switch_off(client, pdo, writes.front(), old_identifier)) writes.pop_back();
  writes.erase(writes.begin());
  try {
    client.write_verified(writes.front());
  } catch (const SdoError& error) {
    if (error.no_answer() || !is_mapped_as_wanted(client, pdo)) throw;
    std::erase_if(writes, [](const SdoWrite& write) { return is_mapping(write.entry); });
  }
  for (const SdoWrite& write : writes) client.write_verified(write);
}

/// Configures `pdo`; if the drive cannot map it, again without its last object, the optional one at `field`.
void configure_with_optional(SdoClient& client, Pdo& pdo, PdoLayout::Field& field,
                             std::vector<std::string>& report, const char* without) {
  if (pdo.objects.empty()) return;
  try {
    return configure_pdo(client, pdo);
  } catch (const SdoError& error) {
    if (error.no_answer() || field.pdo == 0) throw;
  }
  leave_out(pdo, field);
  if (!pdo.objects.empty()) configure_pdo(client, pdo);
  report.push_back(client.who() + ": " + without);
}

// A PDO with a read-only identifier is emptied instead; CiA 301 treats an empty PDO as switched off.
void switch_off_unused(SdoClient& client, PdoDirection direction, int pdo, std::uint32_t old_identifier) {
  const SdoWrite off = canopen::pdo_switched_off(direction, pdo, old_identifier);
  try {
    client.write_verified(off);
  } catch (const SdoError& error) {
    if (!error.read_only()) throw;
    client.write_verified(
        {Pdo{direction, pdo, 1, {}}.mapping(0), 0, 1, ~0U, off.purpose + ", by emptying it"});
  }
}

// Other TPDOs would load the bus, and other RPDOs could command the drive. Except for the first four, drives
// number their PDOs without gaps.
void switch_off_other_pdos(SdoClient& client, const PdoLayout& layout) {
  const auto is_used = [&](PdoDirection direction, int pdo) {
    for (const Pdo* used : {&layout.command, &layout.offsets, &layout.fast, &layout.slow, &layout.probe})
      if (used->direction == direction && used->number == pdo && !used->objects.empty()) return true;
    return false;
  };
  for (const PdoDirection direction : {PdoDirection::kReceive, PdoDirection::kTransmit}) {
    for (int pdo = 1; pdo <= kMostPdos; ++pdo) {
      if (is_used(direction, pdo)) continue;
      const Entry identifier = canopen::pdo_switched_off(direction, pdo, 0).entry;
      const auto old_identifier = client.upload_if_there(identifier, 4);
      if (!old_identifier && pdo > kUsualPdos) break;
      if (!old_identifier || (*old_identifier & canopen::kPdoInvalid) != 0) continue;
      switch_off_unused(client, direction, pdo, static_cast<std::uint32_t>(*old_identifier));
    }
  }
}

}  // namespace

void leave_out(Pdo& pdo, PdoLayout::Field& field) {
  if (field.pdo == 0) return;
  pdo.objects.pop_back();
  field = {};
}

void configure_pdos(SdoClient& client, const DriveConfig& config, PdoLayout& layout,
                    std::vector<std::string>& report) {
  configure_with_optional(client, layout.command, layout.torque_offset, report,
                          "the drive cannot take 60B2h: its loop gets no torque feed-forward for friction");
  configure_with_optional(client, layout.offsets, layout.velocity_offset, report,
                          "the drive cannot take 60B1h: its loop gets no velocity feed-forward");
  PdoLayout::Field none;
  configure_with_optional(client, layout.fast, closes_loop(config.drive_mode) ? layout.torque : none, report,
                          "the drive cannot send 6077h: the daemon learns nothing of its friction");
  configure_with_optional(client, layout.slow, layout.mode, report,
                          "the drive cannot send 6061h in TPDO2: the daemon reads its mode by SDO");
  configure_with_optional(client, layout.probe, none, report, "");
  switch_off_other_pdos(client, layout);
}

bool configure_deadline(SdoClient& client, const DriveConfig& config) {
  try {
    return client.write_if_writable(
        {kCommandDeadline_ms, thousandths(config.command_deadline_s), 2, ~0U, "deadline of RPDO1"});
  } catch (const SdoError& error) {
    if (error.no_answer()) throw;
  } catch (const InputError&) {
    // An entry that keeps 0 means that the drive has no deadline.
  }
  return false;
}

}  // namespace strainwave::cia402
