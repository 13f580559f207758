// SPDX-License-Identifier: BSD-3-Clause
// The server for viewers and Prometheus: HTTP, and on the same port the Foxglove WebSocket protocol. Its
// single thread also receives LCM. Not real-time.
//
// Clients may be hostile: requests and messages have a size limit and a time limit. The numbers of waiting
// connections and of viewers are limited. Data that a slow viewer does not fetch are dropped (send_queue.h).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "telemetry/access.h"
#include "telemetry/acting.h"
#include "telemetry/shared_text.h"
#include "telemetry/topics.h"

namespace strainwave {

struct ServerCounts {
  std::uint64_t viewers = 0;           ///< connected now
  std::uint64_t dropped_messages = 0;  ///< dropped because their viewers were too slow
  std::uint64_t refused = 0;           ///< requests without a token, from foreign pages, or too many
};

class TelemetryServer {
 public:
  /// Connections without a complete request. A further one closes the oldest.
  static constexpr std::size_t kMaxOpening = 64;
  static constexpr std::size_t kMaxViewers = 32;

  /// Starts to listen. `metrics` makes the page /metrics, plain or packed with gzip. `acting` takes orders of the page; null:
  /// orders are not taken. Throws InputError when the address is unavailable. `topics` and `acting` must outlive it.
  TelemetryServer(const ListenAddress& address, AccessRules rules, const Topics& topics,
                  std::function<SharedText(bool packed)> metrics, Acting* acting);
  ~TelemetryServer();
  TelemetryServer(const TelemetryServer&) = delete;
  TelemetryServer& operator=(const TelemetryServer&) = delete;

  /// The port in use, also if any free one was requested.
  std::uint16_t port() const;

  void add_topic(std::uint32_t topic);
  void remove_topic(std::uint32_t topic);
  /// Whether any viewer has subscribed to the topic.
  bool is_wanted(std::uint32_t topic) const;
  void publish(std::uint32_t topic, std::int64_t received_us, std::string json);
  /// Sends a text to the viewer with this number, if it is still connected.
  void say(std::uint64_t viewer, std::string text);

  ServerCounts counts() const;

  /// Serves until SIGINT or SIGTERM. Calls `on_readable` when `descriptor` is readable and once a second, and `on_second` each second.
  void run(int descriptor, const std::function<void()>& on_readable, const std::function<void()>& on_second);

 private:
  class Network;
  std::unique_ptr<Network> network_;
};

}  // namespace strainwave
