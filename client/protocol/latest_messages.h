// SPDX-License-Identifier: BSD-3-Clause
// The latest message of one kind from every joint (or daemon), under any prefix. Bytes from the network are
// hostile: messages of another size or type, and other channels, are ignored. A sender that invents names
// displaces only its own names (transport/fair_places.h). Not real-time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <utility>

#include "client/protocol/clock.h"
#include "client/protocol/connection.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/fingerprints.h"
#include "lcmtypes/wire.h"
#include "transport/fair_places.h"

namespace strainwave {

/// The channel kind of each type of message.
template <typename Message>
inline constexpr std::string_view kKindOf{};
template <>
inline constexpr std::string_view kKindOf<state_v1> = channel_kind::kState;
template <>
inline constexpr std::string_view kKindOf<temperature_v1> = channel_kind::kTemperature;
template <>
inline constexpr std::string_view kKindOf<limits_v1> = channel_kind::kLimits;
template <>
inline constexpr std::string_view kKindOf<timing_v1> = channel_kind::kTiming;

/// Whether a daemon may have sent the message. The limit keeps later arithmetic with cycles from overflow.
template <typename Message>
bool is_believable(const Message&) noexcept {
  return true;
}
inline bool is_believable(const state_v1& state) noexcept {
  constexpr std::int64_t kLargestCycle = std::int64_t{1} << 62;
  return state.cycle >= 0 && state.cycle <= kLargestCycle;
}
inline bool is_believable(const limits_v1& limits) noexcept {
  return limits.period_s >= 1e-6 && limits.period_s <= 1.0;  // wider than the range of any daemon
}

template <typename Type>
struct Latest {
  using Message = Type;
  Message message{};
  Instant received;           ///< by this computer's clock
  std::int64_t messages = 0;  ///< number of messages so far

  void take(const Message& latest) {
    message = latest;
    received = now();
    ++messages;
  }
};

/// `View` is Latest, or a type that remembers more. Its take() is called for each message.
template <typename View>
class LatestMessages {
 public:
  using Message = typename View::Message;
  using Name = std::pair<std::string, std::string>;  ///< prefix, joint (empty: the daemon itself)

  /// Places for names, in addition to kept names. No real network has more.
  static constexpr std::size_t kMaxNames = 1024;
  /// Largest number of prefixes with another version.
  static constexpr std::size_t kMaxOthers = 64;

  /// Starts to listen.
  explicit LatestMessages(Connection& connection)
      : subscription_(connection.subscribe(pattern(), &LatestMessages::on_message, this)) {}

  /// From now on `name` keeps its place. The result of find() for it lasts as long as this object.
  void keep(const Name& name) {
    if (kept_.insert(name).second) places_.leave(name);
  }

  /// Null if no message came yet. Valid until the next message, or for a kept name as long as this object.
  const View* find(const std::string& prefix, const std::string& joint = "") const {
    const auto found = views_.find({prefix, joint});
    return found == views_.end() ? nullptr : &found->second;
  }
  const std::map<Name, View>& all() const noexcept { return views_; }

  /// Whether a program of another version has sent a message under `prefix`.
  bool another_version(const std::string& prefix) const { return others_.contains(prefix); }

  /// Takes one message, as the subscription does.
  void accept(const std::string& channel, std::span<const std::uint8_t> bytes, const LcmSource& from = {}) {
    const auto parts = parse_channel(channel);
    if (!parts || parts->kind != kKindOf<Message>) return;
    const auto message = decode_exactly<Message>(bytes);
    if (!message) {
      if (others_.size() < kMaxOthers && is_of_another_version(parts->kind, bytes))
        others_.insert(parts->prefix);
      return;
    }
    if (!is_believable(*message)) return;
    const Name name(parts->prefix, parts->joint);
    if (!kept_.contains(name))
      if (const auto lost = places_.take(name, from, seconds_between({}, now()))) views_.erase(*lost);
    views_[name].take(*message);
  }

 private:
  static std::string pattern() {
    const bool of_daemon = kKindOf<Message> == channel_kind::kTiming;
    return of_daemon ? "[^.]+\\." + std::string(kKindOf<Message>)
                     : channel_pattern("[^.]+", kKindOf<Message>);
  }
  void on_message(const ReceivedMessage& message) { accept(message.channel, message.bytes, message.from); }

  std::map<Name, View> views_;
  FairPlaces<Name> places_{kMaxNames};
  std::set<std::string> others_;  ///< prefixes
  std::set<Name> kept_;           ///< the program's own names, which are few
  Subscription subscription_;
};

}  // namespace strainwave
