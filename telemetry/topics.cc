// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/topics.h"

#include "base/durations.h"

namespace strainwave {

const Topic* Topics::find(const std::string& name, double now_s) {
  const auto found = topics_.find(name);
  if (found == topics_.end()) return nullptr;
  (void)places_.take(name, {}, now_s);
  return &found->second;
}

const Topic* Topics::add(const std::string& name, const std::string& schema_name, const std::string& schema,
                         double now_s, const LcmSource& from) {
  given_up_.reset();
  if (!new_ones_.try_take(nanoseconds(now_s))) return nullptr;
  if (const auto lost = places_.take(name, from, now_s)) give_up(*lost);
  const std::uint32_t id = next_id_++;
  names_.emplace(id, name);
  return &topics_.insert_or_assign(name, Topic{id, name, schema_name, schema}).first->second;
}

void Topics::give_up(const std::string& name) {
  const auto found = topics_.find(name);
  given_up_ = found->second.id;
  names_.erase(found->second.id);
  topics_.erase(found);
}

}  // namespace strainwave
