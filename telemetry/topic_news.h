// SPDX-License-Identifier: BSD-3-Clause
// The news of topics that one viewer has not received yet. Bounded by the number of topics, however slowly the viewer reads and however
// often names come and go: a topic that came and went meanwhile is left out. Not real-time.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "telemetry/topics.h"

namespace strainwave {

class TopicNews {
 public:
  /// Topics in one message: some ten kilobytes.
  static constexpr std::size_t kAtOnce = 16;

  void offer(std::uint32_t topic) { offered_.insert(topic); }
  /// One that was offered.
  void withdraw(std::uint32_t topic);
  /// Takes out the next message that tells of them, if anything is new: first what is withdrawn, then what is offered, the oldest first.
  std::optional<std::string> pop(const Topics& topics);

  std::size_t size() const noexcept { return offered_.size() + withdrawn_.size(); }

 private:
  std::set<std::uint32_t> offered_;
  std::vector<std::uint32_t> withdrawn_;
};

}  // namespace strainwave
