// SPDX-License-Identifier: BSD-3-Clause
// The server's side of the Foxglove WebSocket protocol for one viewer, without sockets: the server's
// messages, the viewer's requests, and its subscriptions. All input from a viewer is hostile. Not real-time.
//
// Source: Foxglove WebSocket protocol v1 (github.com/foxglove/ws-protocol, docs/spec.md). Its subprotocol was
// foxglove.websocket.v1. Today's Foxglove names it foxglove.sdk.v1, with the same messages.
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

/// The newest supported subprotocol in `offered` (the header Sec-WebSocket-Protocol), if any.
std::optional<std::string_view> choose_subprotocol(std::string_view offered);

/// Messages of the server: first the information, then the topics, later status messages. `acting`: the page
/// may request orders.
std::string server_info(const std::string& session, bool acting);
std::string advertise(std::span<const Topic* const> topics);
std::string unadvertise(std::span<const std::uint32_t> topics);
enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };
/// A later status with the same `id` replaces the earlier one.
std::string status(StatusLevel level, const std::string& message, const std::string& id);

/// The bytes before a message's JSON: opcode 1, subscription, time of receipt in nanoseconds, little-endian.
inline constexpr std::size_t kMessageHeadBytes = 13;
using MessageHead = std::array<std::uint8_t, kMessageHeadBytes>;
MessageHead message_head(std::uint32_t subscription, std::uint64_t received_ns);

class Viewer {
 public:
  /// Longest accepted message of a viewer.
  static constexpr std::size_t kLongestMessage = 65536;

  /// `acting` takes the viewer's orders, and must outlive it; null: orders are not taken.
  explicit Viewer(Acting::Page page = {}, Acting* acting = nullptr) : page_(page), acting_(acting) {}
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Takes one text from the viewer, and returns the answer, if any.
  std::optional<std::string> take(std::string_view text, const Topics& topics, double now_s);

  /// The viewer's number for its subscription to `topic`, if it has one.
  std::optional<std::uint32_t> subscription(std::uint32_t topic) const;
  void forget(std::uint32_t topic);
  std::size_t subscriptions() const noexcept { return by_topic_.size(); }
  std::uint64_t id() const noexcept { return page_.number; }
  /// Whether the server takes orders from this viewer.
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
