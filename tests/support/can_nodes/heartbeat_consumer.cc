// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/heartbeat_consumer.h"

#include <algorithm>

namespace strainwave::can_nodes {

namespace {

std::uint8_t node_of(std::int64_t entry) {
  return static_cast<std::uint8_t>(entry >> 16);
}

std::int64_t time_of_us(std::int64_t entry) {
  return (entry & 0xFFFF) * 1000;
}

}  // namespace

HeartbeatConsumer::HeartbeatConsumer(ObjectDictionary& dictionary) : dictionary_(dictionary) {
  dictionary_.add({0x1016, 0}, {DataType::kUnsigned8, Access::kConstant, kWatchedNodes});
  for (int n = 0; n < kWatchedNodes; ++n)
    dictionary_.add({0x1016, static_cast<std::uint8_t>(n + 1)},
                    {DataType::kUnsigned32, Access::kReadWrite, 0, Mappable::kNo, 0, 0x007FFFFF, {}});
}

void HeartbeatConsumer::heard(std::uint8_t node_id, std::int64_t now_us) {
  for (int n = 0; n < kWatchedNodes; ++n)
    if (node_of(entry(n)) == node_id && time_of_us(entry(n)) > 0)
      deadline_us_[static_cast<std::size_t>(n)] = now_us + time_of_us(entry(n));
}

std::optional<std::uint8_t> HeartbeatConsumer::lost(std::int64_t now_us) {
  for (int n = 0; n < kWatchedNodes; ++n) {
    auto& deadline = deadline_us_[static_cast<std::size_t>(n)];
    if (!deadline || *deadline > now_us) continue;
    deadline.reset();
    return node_of(entry(n));
  }
  return std::nullopt;
}

std::optional<std::int64_t> HeartbeatConsumer::next_deadline_us() const {
  std::optional<std::int64_t> next;
  for (const auto& deadline : deadline_us_)
    if (deadline) next = next ? std::min(*next, *deadline) : *deadline;
  return next;
}

}  // namespace strainwave::can_nodes
