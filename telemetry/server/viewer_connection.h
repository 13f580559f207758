// The connection of one viewer: the Foxglove WebSocket protocol (telemetry/viewer.h) on a socket. Not real-time.
#pragma once

#include <array>

#include "telemetry/send_queue.h"
#include "telemetry/server/shared.h"
#include "telemetry/viewer.h"

namespace strainwave {

class ViewerConnection : public std::enable_shared_from_this<ViewerConnection> {
 public:
  ViewerConnection(boost::beast::tcp_stream&& stream, ServerShared& shared);

  /// Answers the request to become a viewer, then serves it.
  void start(const boost::beast::http::request<boost::beast::http::empty_body>& request,
             std::string_view subprotocol);

  bool wants(std::uint32_t topic) const { return viewer_.subscription(topic).has_value(); }
  void publish(std::uint32_t topic, std::uint64_t received_ns,
               const std::shared_ptr<const std::string>& json);
  void add_topic(const Topic& topic) { say(advertise(topic)); }
  void remove_topic(std::uint32_t topic);
  /// Tells the viewer what it has missed since the last call.
  void report_drops();
  std::uint64_t dropped() const noexcept { return queue_.dropped(); }

 private:
  void read();
  void on_message(const boost::beast::error_code& error);
  void say(std::string text);
  void send();
  void end();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::beast::flat_buffer incoming_;
  ServerShared& shared_;
  Viewer viewer_;
  SendQueue queue_;
  std::optional<OutgoingFrame> sending_;
  std::uint64_t reported_drops_ = 0;
};

}  // namespace strainwave
