// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/topic_news.h"

#include "telemetry/viewer.h"

namespace strainwave {

void TopicNews::withdraw(std::uint32_t topic) {
  if (offered_.erase(topic) == 0) withdrawn_.push_back(topic);
}

std::optional<std::string> TopicNews::pop(const Topics& topics) {
  if (!withdrawn_.empty()) {
    std::string text = unadvertise(withdrawn_);
    withdrawn_.clear();
    return text;
  }
  if (offered_.empty()) return std::nullopt;
  std::vector<const Topic*> told;
  while (!offered_.empty() && told.size() < kAtOnce) {
    told.push_back(&topics.at(*offered_.begin()));
    offered_.erase(offered_.begin());
  }
  return advertise(told);
}

}  // namespace strainwave
