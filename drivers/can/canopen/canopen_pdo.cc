// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/canopen_pdo.h"

#include <numeric>

#include "drivers/can/canopen/canopen.h"

namespace strainwave::canopen {

namespace {

constexpr std::uint16_t kReceiveCommunication = 0x1400;
constexpr std::uint16_t kReceiveMapping = 0x1600;
constexpr std::uint16_t kTransmitCommunication = 0x1800;
constexpr std::uint16_t kTransmitMapping = 0x1A00;
/// The identifiers of PDO n are 100h above those of PDO n - 1.
constexpr std::uint32_t kNumberStep = 0x100;
constexpr std::uint32_t kIdentifierBits = kPdoInvalid | kMaxCanId;

constexpr std::uint8_t kIdentifierSub = 1;
constexpr std::uint8_t kTypeSub = 2;

std::string name_of(const Pdo& pdo) {
  return (pdo.direction == PdoDirection::kTransmit ? "TPDO" : "RPDO") + std::to_string(pdo.number);
}

}  // namespace

std::uint32_t mapping_word(const MappedObject& object) noexcept {
  return static_cast<std::uint32_t>(object.entry.index) << 16U |
         static_cast<std::uint32_t>(object.entry.sub_index) << 8U | object.bytes * 8U;
}

std::uint32_t Pdo::cob_id(std::uint8_t node) const noexcept {
  const CobId first = direction == PdoDirection::kTransmit ? CobId::kTpdo1 : CobId::kRpdo1;
  return canopen::cob_id(first, node) + kNumberStep * static_cast<std::uint32_t>(number - 1);
}

std::size_t Pdo::bytes() const noexcept {
  return std::accumulate(objects.begin(), objects.end(), std::size_t{0},
                         [](std::size_t sum, const MappedObject& object) { return sum + object.bytes; });
}

Entry Pdo::communication(std::uint8_t sub_index) const noexcept {
  const std::uint16_t first =
      direction == PdoDirection::kTransmit ? kTransmitCommunication : kReceiveCommunication;
  return {static_cast<std::uint16_t>(first + number - 1), sub_index};
}

Entry Pdo::mapping(std::uint8_t sub_index) const noexcept {
  const std::uint16_t first = direction == PdoDirection::kTransmit ? kTransmitMapping : kReceiveMapping;
  return {static_cast<std::uint16_t>(first + number - 1), sub_index};
}

std::vector<SdoWrite> pdo_configuration(const Pdo& pdo, std::uint8_t node, std::uint32_t old_identifier) {
  const std::uint32_t identifier = pdo.cob_id(node) | (old_identifier & kPdoNoRemoteRequest);
  const std::string name = name_of(pdo);
  const auto count = static_cast<std::uint8_t>(pdo.objects.size());
  std::vector<SdoWrite> writes;
  writes.push_back(
      {pdo.communication(kIdentifierSub), old_identifier | kPdoInvalid, 4, kPdoInvalid, name + " off"});
  writes.push_back({pdo.mapping(0), 0, 1, ~0U, name + " emptied"});
  writes.push_back({pdo.communication(kTypeSub), pdo.transmission_type, 1, ~0U, name + " transmission type"});
  for (std::uint8_t i = 0; i < count; ++i)
    writes.push_back({pdo.mapping(static_cast<std::uint8_t>(i + 1)), mapping_word(pdo.objects[i]), 4, ~0U,
                      name + " object " + to_text(pdo.objects[i].entry)});
  writes.push_back({pdo.mapping(0), count, 1, ~0U, name + " count of objects"});
  writes.push_back({pdo.communication(kIdentifierSub), identifier, 4, kIdentifierBits, name + " on"});
  return writes;
}

SdoWrite pdo_switched_off(PdoDirection direction, int number, std::uint32_t old_identifier) {
  Pdo pdo;
  pdo.direction = direction;
  pdo.number = number;
  return {pdo.communication(kIdentifierSub), old_identifier | kPdoInvalid, 4, kPdoInvalid,
          name_of(pdo) + " off"};
}

}  // namespace strainwave::canopen
