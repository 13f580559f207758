// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/canopen/canopen.h"

#include <algorithm>
#include <array>

#include "drivers/can/hexadecimal.h"

namespace strainwave::canopen {

namespace {

CanFrame frame_of(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) noexcept {
  CanFrame frame;
  frame.id = id;
  frame.size = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.bytes.begin());
  return frame;
}

struct CodeText {
  std::uint16_t code;
  std::uint16_t mask;  ///< digits of the code that must match
  std::string_view text;
};

// The first match counts, so single codes stand before their classes. Source: CiA 301 table 26 and CiA 402-2
// section 6.
constexpr std::array kEmergencyTexts{
    CodeText{0x2310, 0xFFFF, "continuous over-current at the output"},
    CodeText{0x2320, 0xFFFF, "short circuit or earth leakage at the output"},
    CodeText{0x2340, 0xFFFF, "short circuit at the output"},
    CodeText{0x2350, 0xFFFF, "load level fault: I2t, thermal state"},
    CodeText{0x3110, 0xFFFF, "mains over-voltage"},
    CodeText{0x3120, 0xFFFF, "mains under-voltage"},
    CodeText{0x3210, 0xFFFF, "over-voltage of the supply"},
    CodeText{0x3220, 0xFFFF, "under-voltage of the supply"},
    CodeText{0x4210, 0xFFFF, "drive too hot"},
    CodeText{0x4220, 0xFFFF, "drive too cold"},
    CodeText{0x4310, 0xFFFF, "drive temperature: too hot"},
    CodeText{0x4410, 0xFFFF, "motor too hot"},
    CodeText{0x5113, 0xFFFF, "supply of the logic out of range"},
    CodeText{0x5441, 0xFFFF, "safety input: limit or enable switch"},
    CodeText{0x6320, 0xFFFF, "parameter error"},
    CodeText{0x7110, 0xFFFF, "brake chopper"},
    CodeText{0x7121, 0xFFFF, "motor blocked"},
    CodeText{0x7300, 0xFF00, "position sensor"},
    CodeText{0x8110, 0xFFFF, "bus: messages lost (overrun)"},
    CodeText{0x8120, 0xFFFF, "bus: error-passive"},
    CodeText{0x8130, 0xFFFF, "bus: our heartbeat was missed"},
    CodeText{0x8140, 0xFFFF, "bus: recovered from bus-off"},
    CodeText{0x8150, 0xFFFF, "bus: identifier collision"},
    CodeText{0x8210, 0xFFFF, "PDO not processed: wrong length"},
    CodeText{0x8220, 0xFFFF, "PDO longer than mapped"},
    CodeText{0x8240, 0xFFFF, "SYNC of an unexpected length"},
    CodeText{0x8250, 0xFFFF, "RPDO time-out"},
    CodeText{0x8311, 0xFFFF, "torque beyond its limit"},
    CodeText{0x8400, 0xFF00, "speed control"},
    CodeText{0x8500, 0xFF00, "position control"},
    CodeText{0x8611, 0xFFFF, "following error in the drive"},
    CodeText{0x0000, 0xFF00, "no error"},
    CodeText{0x1000, 0xFF00, "generic error"},
    CodeText{0x2000, 0xF000, "current"},
    CodeText{0x3000, 0xF000, "voltage"},
    CodeText{0x4000, 0xF000, "temperature"},
    CodeText{0x5000, 0xF000, "drive hardware"},
    CodeText{0x6000, 0xF000, "drive software"},
    CodeText{0x7000, 0xF000, "additional modules: motor, sensor, brake"},
    CodeText{0x8100, 0xFF00, "communication"},
    CodeText{0x8200, 0xFF00, "protocol"},
    CodeText{0x8000, 0xF000, "monitoring"},
    CodeText{0x9000, 0xFF00, "external error"},
    CodeText{0xF000, 0xFF00, "additional functions"},
    CodeText{0xFF00, 0xFF00, "device-specific"},
};

}  // namespace

std::string_view to_text(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "boot-up";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
  }
  return "unknown";
}

CanFrame nmt_frame(NmtCommand command, std::uint8_t node) noexcept {
  return frame_of(cob_id(CobId::kNmt), {static_cast<std::uint8_t>(command), node});
}

CanFrame sync_frame() noexcept {
  return frame_of(cob_id(CobId::kSync), {});
}

CanFrame heartbeat_frame(std::uint8_t node, NmtState state) noexcept {
  return frame_of(cob_id(CobId::kHeartbeat, node), {static_cast<std::uint8_t>(state)});
}

std::optional<NmtState> decode_heartbeat(const CanFrame& frame) noexcept {
  if (frame.size != 1) return std::nullopt;
  // Bit 7 belongs to node guarding, which is not used.
  const auto state = static_cast<NmtState>(frame.bytes[0]);
  switch (state) {
    case NmtState::kBootUp:
    case NmtState::kStopped:
    case NmtState::kOperational:
    case NmtState::kPreOperational:
      return state;
  }
  return std::nullopt;
}

std::optional<Emergency> decode_emergency(const CanFrame& frame) noexcept {
  if (frame.size != kMaxCanBytes) return std::nullopt;
  return Emergency{static_cast<std::uint16_t>(little_endian(frame.bytes.data(), 2)), frame.bytes[2]};
}

std::string_view emergency_text(std::uint16_t code) noexcept {
  for (const CodeText& entry : kEmergencyTexts)
    if ((code & entry.mask) == entry.code) return entry.text;
  return "reserved code";
}

std::string drive_error_text(std::uint32_t drive_error) {
  const auto code = static_cast<std::uint16_t>(drive_error & 0xFFFFU);
  return "emergency " + hexadecimal(code, 4) + ", " + std::string(emergency_text(code)) + " (register " +
         hexadecimal(drive_error >> 16U & 0xFFU, 2) + ")";
}

}  // namespace strainwave::canopen
