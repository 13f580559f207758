// SPDX-License-Identifier: BSD-3-Clause
// The news of topics that one viewer has not received yet. The number of topics bounds them, even for a slow
// viewer and short-lived names. A topic that came and went in the meantime is left out. Not real-time.
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
  /// Topics in one message: about ten kilobytes.
  static constexpr std::size_t kAtOnce = 16;

  void offer(std::uint32_t topic) { offered_.insert(topic); }
  /// The topic was offered before.
  void withdraw(std::uint32_t topic);
  /// Removes and returns the next message of news, if any: withdrawn topics first, then offered ones from the oldest.
  std::optional<std::string> pop(const Topics& topics);

  std::size_t size() const noexcept { return offered_.size() + withdrawn_.size(); }

 private:
  std::set<std::uint32_t> offered_;
  std::vector<std::uint32_t> withdrawn_;
};

}  // namespace strainwave
