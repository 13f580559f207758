// SPDX-License-Identifier: BSD-3-Clause
// The topics of viewers, one per channel heard: a number, a name, a schema. They are bounded: a source that invents names
// displaces only its own (transport/fair_places.h). The rate of new topics stays below the speed of viewers. Not real-time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/token_bucket.h"
#include "transport/fair_places.h"

namespace strainwave {

struct Topic {
  std::uint32_t id = 0;     ///< never given to another topic
  std::string name;         ///< LCM's channel
  std::string schema_name;  ///< "strainwave.state_v1"
  std::string schema;       ///< a JSON schema of its messages
};

class Topics {
 public:
  static constexpr std::size_t kMax = 1024;
  /// New topics per second, after a burst of kMax. Each goes to every viewer with some kilobytes of schema.
  static constexpr double kNewPerSecond = 50.0;

  /// The topic `name`, or null if unknown.
  const Topic* find(const std::string& name, double now_s);
  /// Adds a topic that find() does not know, heard from `from`. Null if too many came; the next message may add it.
  const Topic* add(const std::string& name, const std::string& schema_name, const std::string& schema,
                   double now_s, const LcmSource& from = {});
  /// The topic that the last add() removed to make room, if any.
  std::optional<std::uint32_t> given_up() const noexcept { return given_up_; }

  bool has(std::uint32_t id) const noexcept { return names_.contains(id); }
  /// The topic with the number `id`, for which has() is true.
  const Topic& at(std::uint32_t id) const { return topics_.at(names_.at(id)); }
  std::size_t size() const noexcept { return topics_.size(); }
  template <typename Visit>
  void visit(Visit&& visit) const {
    for (const auto& [name, topic] : topics_) visit(topic);
  }

 private:
  void give_up(const std::string& name);

  std::map<std::string, Topic> topics_;
  FairPlaces<std::string> places_{kMax};
  std::map<std::uint32_t, std::string> names_;
  std::uint32_t next_id_ = 1;
  std::optional<std::uint32_t> given_up_;
  TokenBucket new_ones_{kNewPerSecond, static_cast<double>(kMax)};
};

}  // namespace strainwave
