// SPDX-License-Identifier: BSD-3-Clause
// One viewer's side of the Foxglove WebSocket protocol, without sockets: what the server says first, what a viewer may ask, and which
// topics it wants. Everything that comes from a viewer is hostile. Not real-time.
//
// Source: Foxglove WebSocket protocol v1 (github.com/foxglove/ws-protocol, docs/spec.md); its subprotocol was foxglove.websocket.v1,
// and is foxglove.sdk.v1 in today's Foxglove, with the same messages.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "telemetry/acting.h"
#include "telemetry/topics.h"

namespace strainwave {

/// The newest of the subprotocols in `offered` (as in the header Sec-WebSocket-Protocol) that is spoken here, or nothing.
std::optional<std::string_view> choose_subprotocol(std::string_view offered);

/// What the server sends: first the information, then the topics, and what there is to say.
/// `acting`: the page may ask for orders.
std::string server_info(const std::string& session, bool acting);
std::string advertise(std::span<const Topic* const> topics);
std::string unadvertise(std::span<const std::uint32_t> topics);
enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };
/// A later status of the same `id` takes the place of the earlier one.
std::string status(StatusLevel level, const std::string& message, const std::string& id);

/// What stands before a message's JSON: opcode 1, subscription, time of receipt in nanoseconds, little-endian.
inline constexpr std::size_t kMessageHeadBytes = 13;
using MessageHead = std::array<std::uint8_t, kMessageHeadBytes>;
MessageHead message_head(std::uint32_t subscription, std::uint64_t received_ns);

class Viewer {
 public:
  /// Longer messages than this no viewer needs.
  static constexpr std::size_t kLongestMessage = 65536;

  /// `acting`: what takes its orders, and outlives it; null: nothing does.
  explicit Viewer(Acting::Page page = {}, Acting* acting = nullptr) : page_(page), acting_(acting) {}
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Takes one text from the viewer; what is to be answered, if anything.
  std::optional<std::string> take(std::string_view text, const Topics& topics, double now_s);

  /// Under which number the viewer wants the messages of `topic`, if it does.
  std::optional<std::uint32_t> subscription(std::uint32_t topic) const;
  void forget(std::uint32_t topic);
  std::size_t subscriptions() const noexcept { return by_topic_.size(); }
  std::uint64_t id() const noexcept { return page_.number; }
  /// Orders are taken, and from this viewer.
  bool may_act() const noexcept { return acting_ != nullptr && page_.is_own; }

 private:
  std::string subscribe(std::uint32_t id, std::uint32_t topic, const Topics& topics);
  std::string unsubscribe(std::uint32_t id);

  Acting::Page page_;
  Acting* acting_;
  std::map<std::uint32_t, std::uint32_t> by_topic_;  ///< topic to subscription
  std::map<std::uint32_t, std::uint32_t> topic_of_;  ///< subscription to topic
};

}  // namespace strainwave
