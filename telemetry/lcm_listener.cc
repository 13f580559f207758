// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/lcm_listener.h"

#include <system_error>

#include "lcmtypes/multicast_check.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr int kBatchesAtOnce = 8;

}  // namespace

LcmListener::LcmListener(const std::string& lcm_url)
    : socket_(*parse_udpm_url(lcm_url), largest_datagram(kLargestMessageBytes)),
      reassembly_(kLargestMessageBytes) {}

void LcmListener::receive(const Take& take) {
  const auto take_datagram = [&](const LcmSource& from, std::span<const std::uint8_t> datagram) {
    if (const auto message = reassembly_.take(from, datagram)) take(from, message->channel, message->bytes);
  };
  socket_.follow_route();
  for (int batch = 0; batch < kBatchesAtOnce; ++batch)
    if (socket_.receive(take_datagram) < LcmSocket::kBatch) return;
}

}  // namespace strainwave
