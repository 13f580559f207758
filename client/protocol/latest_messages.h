// SPDX-License-Identifier: BSD-3-Clause
// The latest message of one kind from every joint (or daemon) that is heard, under any prefix. Bytes from the network are
// hostile: messages of another size or type, and other channels, are ignored. A sender that makes up names loses only its own
// (transport/fair_places.h). Not real-time.
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

/// Where each type of message comes from.
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

/// Whether a daemon may have sent it. With the time of a sample, such a cycle yet fits into a message.
template <typename Message>
bool is_believable(const Message&) noexcept {
  return true;
}
inline bool is_believable(const state_v1& state) noexcept {
  constexpr std::int64_t kLargestCycle = std::int64_t{1} << 62;
  return state.cycle >= 0 && state.cycle <= kLargestCycle;
}
inline bool is_believable(const limits_v1& limits) noexcept {
  return limits.period_s >= 1e-6 && limits.period_s <= 1.0;  // wider than those of any daemon
}

template <typename Type>
struct Latest {
  using Message = Type;
  Message message{};
  Instant received;           ///< by our own clock
  std::int64_t messages = 0;  ///< received so far

  void take(const Message& latest) {
    message = latest;
    received = now();
    ++messages;
  }
};

/// `View`: Latest, or what remembers more of its messages; take() is called for each.
template <typename View>
class LatestMessages {
 public:
  using Message = typename View::Message;
  using Name = std::pair<std::string, std::string>;  ///< prefix, joint (empty: the daemon as a whole)

  /// More names than any network of ours has, besides those that are kept.
  static constexpr std::size_t kMaxNames = 1024;
  /// Prefixes on which another version was heard.
  static constexpr std::size_t kMaxOthers = 64;

  /// Starts to listen.
  explicit LatestMessages(Connection& connection)
      : subscription_(connection.subscribe(pattern(), &LatestMessages::on_message, this)) {}

  /// From now on `name` keeps its place: what find() returned of it lasts as long as this object.
  void keep(const Name& name) {
    if (kept_.insert(name).second) places_.leave(name);
  }

  /// Null when nothing was heard yet. Lasts until the next message, for ever if the name is kept.
  const View* find(const std::string& prefix, const std::string& joint = "") const {
    const auto found = views_.find({prefix, joint});
    return found == views_.end() ? nullptr : &found->second;
  }
  const std::map<Name, View>& all() const noexcept { return views_; }

  /// Whether a message came under `prefix` that a program of another version sends.
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
  std::set<Name> kept_;           ///< of a program's own, so that they are not many
  Subscription subscription_;
};

}  // namespace strainwave
