// SPDX-License-Identifier: BSD-3-Clause
// The outgoing messages of one viewer, except news of topics (topic_news.h). The queue is bounded in bytes.
// If the viewer is too slow, the queue drops the oldest data first, and counts them. Answers go first and are
// never dropped. A viewer with too many unread answers is disconnected. Not real-time.
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
  std::optional<MessageHead> head;  ///< head of binary data; none: a text
  SharedText body;                  ///< shared by all viewers
};

class SendQueue {
 public:
  static constexpr std::size_t kMaxDataBytes = 2U << 20U;
  static constexpr std::size_t kMaxControlBytes = 4U << 20U;

  /// Returns false if too much is waiting. End the connection then.
  bool push_control(std::string text);
  void push_data(const MessageHead& head, SharedText body);
  /// Removes and returns the next frame to send, if any.
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
