// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/lcm_sender.h"

#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "base/input_error.h"

namespace strainwave {

PendingOrder::Publish lcm_sender(const std::string& lcm_url) {
  const auto sender = std::make_shared<lcm::LCM>(lcm_url);
  if (!sender->good()) throw InputError("--lcm-url: LCM cannot send on '" + lcm_url + "'");
  return [sender](const std::string& channel, std::span<const std::uint8_t> bytes) {
    (void)sender->publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size()));
  };
}

}  // namespace strainwave
