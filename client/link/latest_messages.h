// The latest message of one kind from every joint (or daemon) that is heard, under any prefix. Bytes from the network are
// hostile: messages of another size or type, and channels that are none of ours, are ignored. Not real-time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <utility>

#include "client/link/clock.h"
#include "client/link/connection.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"

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

  /// More names than any network of ours has; whoever sends more is not a daemon.
  static constexpr std::size_t kMaxNames = 1024;

  /// Starts to listen.
  explicit LatestMessages(Connection& connection)
      : subscription_(connection.subscribe(pattern(), &LatestMessages::on_message, this)) {}

  /// Null when nothing was heard yet.
  const View* find(const std::string& prefix, const std::string& joint = "") const {
    const auto found = views_.find({prefix, joint});
    return found == views_.end() ? nullptr : &found->second;
  }
  const std::map<Name, View>& all() const noexcept { return views_; }

  /// Takes one message, as the subscription does.
  void accept(const std::string& channel, std::span<const std::uint8_t> bytes) {
    const auto parts = parse_channel(channel);
    if (!parts || parts->kind != kKindOf<Message>) return;
    const auto message = decode_exactly<Message>(bytes);
    if (!message) return;
    const Name name(parts->prefix, parts->joint);
    if (views_.size() < kMaxNames || views_.contains(name)) views_[name].take(*message);
  }

 private:
  static std::string pattern() {
    const bool of_daemon = kKindOf<Message> == channel_kind::kTiming;
    return of_daemon ? "[^.]+\\." + std::string(kKindOf<Message>)
                     : channel_pattern("[^.]+", kKindOf<Message>);
  }
  void on_message(const ReceivedMessage& message) { accept(message.channel, message.bytes); }

  std::map<Name, View> views_;
  Subscription subscription_;
};

}  // namespace strainwave
