// SPDX-License-Identifier: BSD-3-Clause
// A message as the gateway passes it to the core, signed if a key is given.
#pragma once

#include <algorithm>
#include <string>

#include "daemon/gateway/shared_memory.h"
#include "lcmtypes/signing.h"
#include "lcmtypes/wire.h"

namespace strainwave {

template <typename Message>
WireMessage wire(const std::string& channel, const Message& message, const SecretKey* key = nullptr) {
  WireMessage result;
  result.channel = FixedString<64>(channel);
  auto bytes = encode(message);
  if (key != nullptr) sign(channel, *key, bytes);
  result.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), result.bytes.begin());
  return result;
}

}  // namespace strainwave
