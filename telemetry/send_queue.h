// SPDX-License-Identifier: BSD-3-Clause
// What waits to be sent to one viewer, but for news of topics (topic_news.h). Bounded in bytes: data of a viewer that is too slow are
// dropped, the oldest first, and counted. What a viewer is answered goes first and is never dropped: one that asks and lets too much of
// that pile up is given up. Not real-time.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "telemetry/shared_text.h"
#include "telemetry/viewer.h"

namespace strainwave {

struct OutgoingFrame {
  std::optional<MessageHead> head;  ///< of data, sent as binary; none: text
  SharedText body;                  ///< shared by all viewers
};

class SendQueue {
 public:
  static constexpr std::size_t kMaxDataBytes = 2U << 20U;
  static constexpr std::size_t kMaxControlBytes = 4U << 20U;

  /// False: too much is waiting, end the connection.
  bool push_control(std::string text);
  void push_data(const MessageHead& head, SharedText body);
  /// Takes out what is to be sent next, if anything.
  std::optional<OutgoingFrame> pop();

  std::uint64_t dropped() const noexcept { return dropped_; }
  std::size_t waiting_bytes() const noexcept { return control_bytes_ + data_bytes_; }

 private:
  std::deque<OutgoingFrame> control_;
  std::deque<OutgoingFrame> data_;
  std::size_t control_bytes_ = 0;
  std::size_t data_bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace strainwave
