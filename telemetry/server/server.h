// SPDX-License-Identifier: BSD-3-Clause
// The server that viewers and Prometheus connect to: HTTP, and on the same port the Foxglove WebSocket protocol. One thread, which also
// hears LCM. Not real-time.
//
// A client may be hostile: requests and messages have a largest size and a time in which they must be complete. The numbers of
// waiting connections and of viewers are limited. What a slow viewer does not fetch is dropped (send_queue.h).
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
  std::uint64_t dropped_messages = 0;  ///< not sent, since their viewers were too slow
  std::uint64_t refused = 0;           ///< requests without a token, from foreign pages, or too many
};

class TelemetryServer {
 public:
  /// Connections whose request is not here yet; one more pushes out the oldest.
  static constexpr std::size_t kMaxOpening = 64;
  static constexpr std::size_t kMaxViewers = 32;

  /// Listens. `metrics` makes the page /metrics, plain or packed by gzip. `acting` takes orders of the page; null: none are taken. Throws
  /// InputError when the address cannot be had. `topics` and `acting` must outlive it.
  TelemetryServer(const ListenAddress& address, AccessRules rules, const Topics& topics,
                  std::function<SharedText(bool packed)> metrics, Acting* acting);
  ~TelemetryServer();
  TelemetryServer(const TelemetryServer&) = delete;
  TelemetryServer& operator=(const TelemetryServer&) = delete;

  /// The port, also when any was asked for.
  std::uint16_t port() const;

  void add_topic(std::uint32_t topic);
  void remove_topic(std::uint32_t topic);
  /// Whether any viewer wants it.
  bool is_wanted(std::uint32_t topic) const;
  void publish(std::uint32_t topic, std::int64_t received_us, std::string json);
  /// To the viewer of that number, if it is still there.
  void say(std::uint64_t viewer, std::string text);

  ServerCounts counts() const;

  /// Serves until SIGINT or SIGTERM; calls `on_readable` when `descriptor` has something to read, and `on_second` each second.
  void run(int descriptor, const std::function<void()>& on_readable, const std::function<void()>& on_second);

 private:
  class Network;
  std::unique_ptr<Network> network_;
};

}  // namespace strainwave
