// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_description.h"

#include <array>

#include "drivers/can/cia402/cia402_objects.h"
#include "drivers/can/cia402/setup_steps.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::cia402 {

namespace {

using canopen::Entry;
using canopen::SdoClient;

constexpr Entry kDeviceName{0x1008, 0};
constexpr std::uint16_t kIdentityObject = 0x1018;
constexpr Entry kSupportedModes{0x6502, 0};
constexpr std::uint32_t kServoProfile = 0x0192;
constexpr std::uint32_t kProfileMask = 0xFFFF;

}  // namespace

Description describe(SdoClient& client) {
  Description found;
  found.device_type = number(client, kDeviceType);
  found.vendor_id = number(client, {kIdentityObject, 1});
  const auto optional = [&](std::uint8_t sub_index) {
    return static_cast<std::uint32_t>(client.upload_if_there({kIdentityObject, sub_index}, 4).value_or(0));
  };
  found.product_code = optional(2);
  found.revision_number = optional(3);
  found.serial_number = optional(4);
  if (is_servo_drive(found))
    if (const auto modes = client.upload_if_there(kSupportedModes, 4))
      found.supported_modes = static_cast<std::uint32_t>(*modes);
  try {
    found.device_name = client.upload_text(kDeviceName);
  } catch (const canopen::SdoError&) {
    // The name is optional; it only serves messages.
  }
  return found;
}

bool is_servo_drive(const Description& description) noexcept {
  return (description.device_type & kProfileMask) == kServoProfile;
}

std::string to_text(const Description& found) {
  return (found.device_name.empty() ? "" : "\"" + found.device_name + "\" ") + "vendor " +
         hexadecimal(found.vendor_id, 8) + ", product " + hexadecimal(found.product_code, 8) + ", revision " +
         hexadecimal(found.revision_number, 8) + ", serial " + hexadecimal(found.serial_number, 8);
}

std::string modes_text(std::uint32_t supported_modes) {
  constexpr std::array<const char*, 11> kNames{"PP", "VL",  "PV",  "TQ",  "",     "HM",
                                               "IP", "CSP", "CSV", "CST", "CSTCA"};
  std::string text;
  for (std::size_t bit = 0; bit < kNames.size(); ++bit)
    if ((supported_modes >> bit & 1U) != 0 && *kNames[bit] != '\0')
      text += (text.empty() ? "" : " ") + std::string(kNames[bit]);
  return text.empty() ? "none" : text;
}

}  // namespace strainwave::cia402
