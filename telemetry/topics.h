// The channels that are heard as topics of viewers: a number, a name, a schema. Bounded: who makes up names pushes out what has been
// silent, never what is spoken on. Not real-time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

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
  /// A topic that has been silent as long may be given up for a new one.
  static constexpr double kSilent_s = 60.0;

  /// The topic `name`, or null when it is not known.
  const Topic* find(const std::string& name, double now_s);
  /// Adds a topic that find() does not know. Null: there is no room, and every topic is in use.
  const Topic* add(const std::string& name, const std::string& schema_name, const std::string& schema,
                   double now_s);
  /// The one that the last add() gave up for it.
  std::optional<std::uint32_t> given_up() const noexcept { return given_up_; }

  bool has(std::uint32_t id) const noexcept { return names_.contains(id); }
  std::size_t size() const noexcept { return topics_.size(); }
  template <typename Visit>
  void visit(Visit&& visit) const {
    for (const auto& [name, entry] : topics_) visit(entry.topic);
  }

 private:
  struct Entry {
    Topic topic;
    double heard_s = 0.0;
  };
  bool make_room(double now_s);

  std::map<std::string, Entry> topics_;
  std::map<std::uint32_t, std::string> names_;
  std::uint32_t next_id_ = 1;
  std::optional<std::uint32_t> given_up_;
};

}  // namespace strainwave
