#include "telemetry/topics.h"

#include <algorithm>

namespace strainwave {

const Topic* Topics::find(const std::string& name, double now_s) {
  const auto found = topics_.find(name);
  if (found == topics_.end()) return nullptr;
  found->second.heard_s = now_s;
  return &found->second.topic;
}

const Topic* Topics::add(const std::string& name, const std::string& schema_name, const std::string& schema,
                         double now_s) {
  given_up_.reset();
  if (topics_.size() >= kMax && !make_room(now_s)) return nullptr;
  const std::uint32_t id = next_id_++;
  names_.emplace(id, name);
  return &topics_.insert_or_assign(name, Entry{{id, name, schema_name, schema}, now_s}).first->second.topic;
}

bool Topics::make_room(double now_s) {
  const auto oldest = std::min_element(topics_.begin(), topics_.end(), [](const auto& a, const auto& b) {
    return a.second.heard_s < b.second.heard_s;
  });
  if (now_s - oldest->second.heard_s < kSilent_s) return false;
  given_up_ = oldest->second.topic.id;
  names_.erase(oldest->second.topic.id);
  topics_.erase(oldest);
  return true;
}

}  // namespace strainwave
