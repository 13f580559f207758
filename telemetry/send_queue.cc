// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/send_queue.h"

#include <utility>

namespace strainwave {

namespace {

// A frame takes memory in addition to its text.
std::size_t bytes_of(const OutgoingFrame& frame) {
  return sizeof(OutgoingFrame) + frame.body->size();
}

OutgoingFrame take_first(std::deque<OutgoingFrame>& frames, std::size_t& bytes) {
  OutgoingFrame frame = std::move(frames.front());
  frames.pop_front();
  bytes -= bytes_of(frame);
  return frame;
}

}  // namespace

bool SendQueue::push_control(std::string text) {
  control_.push_back({std::nullopt, std::make_shared<const std::string>(std::move(text))});
  control_bytes_ += bytes_of(control_.back());
  return control_bytes_ <= kMaxControlBytes;
}

void SendQueue::push_data(const MessageHead& head, SharedText body) {
  data_.push_back({head, std::move(body)});
  data_bytes_ += bytes_of(data_.back());
  while (data_bytes_ > kMaxDataBytes) {
    take_first(data_, data_bytes_);
    ++dropped_;
  }
}

std::optional<OutgoingFrame> SendQueue::pop() {
  if (!control_.empty()) return take_first(control_, control_bytes_);
  if (!data_.empty()) return take_first(data_, data_bytes_);
  return std::nullopt;
}

}  // namespace strainwave
