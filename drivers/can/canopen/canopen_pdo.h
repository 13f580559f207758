// SPDX-License-Identifier: BSD-3-Clause
// Process data objects: the settings for the PDOs of a drive, and their layout. Pure functions; the noexcept
// ones are real-time safe. Source: CiA 301 v4.2.0, sections 7.2.2 and 7.5.2.35 to 38.
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
/// Returns index, sub-index and length in bits, in the format of the drive's mapping.
std::uint32_t mapping_word(const MappedObject& object) noexcept;

/// One PDO. Numbers count from 1; the identifiers are those of the predefined connection set.
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

/// Bits of a PDO's identifier entry. Bit 31: the PDO is invalid. Bit 30: no remote requests; some drives do
/// not let it be changed.
inline constexpr std::uint32_t kPdoInvalid = 1U << 31U;
inline constexpr std::uint32_t kPdoNoRemoteRequest = 1U << 30U;

/// An entry to write and then read back.
struct SdoWrite {
  Entry entry;
  std::uint32_t value = 0;
  std::uint8_t bytes = 4;        ///< 1, 2 or 4
  std::uint32_t verified = ~0U;  ///< bits that are compared with the value read back
  std::string purpose;           ///< for messages
};

/// Returns the writes in the order of the standard: invalid, no objects, type, objects, their count, valid.
/// `old_identifier` is the drive's present entry, whose bit 30 is kept. An identifier must not change while
/// its PDO is valid. So the first write changes only bit 31, and the last one writes the new identifier.
std::vector<SdoWrite> pdo_configuration(const Pdo& pdo, std::uint8_t node, std::uint32_t old_identifier);
/// Returns the write that switches off an unused PDO.
SdoWrite pdo_switched_off(PdoDirection direction, int number, std::uint32_t old_identifier);

}  // namespace strainwave::canopen
