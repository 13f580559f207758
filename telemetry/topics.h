// SPDX-License-Identifier: BSD-3-Clause
// The channels that are heard as topics of viewers: a number, a name, a schema. Bounded: a source that makes up names loses only its own
// (transport/fair_places.h), and topics are not made faster than viewers can receive them. Not real-time.
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
  /// New ones a second, once kMax came at once. Each goes to every viewer with some kilobytes of schema.
  static constexpr double kNewPerSecond = 50.0;

  /// The topic `name`, or null when it is not known.
  const Topic* find(const std::string& name, double now_s);
  /// Adds a topic that find() does not know, heard from `from`. Null: too many came, it may be added when it is heard again.
  const Topic* add(const std::string& name, const std::string& schema_name, const std::string& schema,
                   double now_s, const LcmSource& from = {});
  /// The one that the last add() gave up for it.
  std::optional<std::uint32_t> given_up() const noexcept { return given_up_; }

  bool has(std::uint32_t id) const noexcept { return names_.contains(id); }
  /// The topic of the number `id`, which has() one.
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
