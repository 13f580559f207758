// SPDX-License-Identifier: BSD-3-Clause
// Process data objects: the settings by which a drive sends and takes what we want, and the fields of a
// frame. Pure functions; reading and writing fields is real-time safe. Source: CiA 301 v4.2.0, sections 7.2.2
// and 7.5.2.35 to 38.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/can/canopen/canopen_sdo.h"

namespace strainwave::canopen {

enum class PdoDirection { kTransmit, kReceive };  ///< seen from the drive: TPDO, RPDO

struct MappedObject {
  Entry entry;
  std::uint8_t bytes = 0;  ///< 1, 2, 4 or 8
};
/// Index, sub-index and length in bits, as the drive's mapping holds it.
std::uint32_t mapping_word(const MappedObject& object) noexcept;

/// One PDO. Numbers count from 1; identifiers are those of the predefined connection set.
struct Pdo {
  PdoDirection direction = PdoDirection::kTransmit;
  int number = 1;                      ///< 1..4
  std::uint8_t transmission_type = 1;  ///< n: with every nth SYNC (1..240); an RPDO acts at the next SYNC
  std::vector<MappedObject> objects;   ///< 1 to 8 of them, together at most 8 bytes

  std::uint32_t cob_id(std::uint8_t node) const noexcept;
  std::size_t bytes() const noexcept;
  Entry communication(std::uint8_t sub_index) const noexcept;  ///< of 1400h or 1800h onwards
  Entry mapping(std::uint8_t sub_index) const noexcept;        ///< of 1600h or 1A00h onwards
};

/// Bit 31 of a PDO's identifier entry: it does not exist. Bit 30: no remote requests; a drive may not let it
/// be changed.
inline constexpr std::uint32_t kPdoInvalid = 1U << 31U;
inline constexpr std::uint32_t kPdoNoRemoteRequest = 1U << 30U;

/// One entry to write, and to read back.
struct SdoWrite {
  Entry entry;
  std::uint32_t value = 0;
  std::uint8_t bytes = 4;        ///< 1, 2 or 4
  std::uint32_t verified = ~0U;  ///< bits that reading back must find again
  std::string purpose;           ///< for messages
};

/// What to write, in the standard's order: invalid, no objects, type, objects, their count, valid.
/// `old_identifier` is what the drive holds now; its bit 30 is kept. An identifier may not change while its PDO
/// exists, so the first write changes bit 31 alone and the last one brings the new identifier.
std::vector<SdoWrite> pdo_configuration(const Pdo& pdo, std::uint8_t node, std::uint32_t old_identifier);
/// Switches off a PDO that is not wanted.
SdoWrite pdo_switched_off(PdoDirection direction, int number, std::uint32_t old_identifier);

}  // namespace strainwave::canopen
