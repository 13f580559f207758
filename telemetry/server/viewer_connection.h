// SPDX-License-Identifier: BSD-3-Clause
// The connection of one viewer: the Foxglove WebSocket protocol (telemetry/viewer.h) on a socket. Not real-time.
#pragma once

#include <array>

#include "telemetry/send_queue.h"
#include "telemetry/server/shared.h"
#include "telemetry/topic_news.h"
#include "telemetry/viewer.h"

namespace strainwave {

class ViewerConnection : public std::enable_shared_from_this<ViewerConnection> {
 public:
  /// `own_page`: see is_from_own_page().
  ViewerConnection(boost::beast::tcp_stream&& stream, ServerShared& shared, bool own_page);

  /// Answers the request to become a viewer, then serves it.
  void start(const boost::beast::http::request<boost::beast::http::empty_body>& request,
             std::string_view subprotocol);

  bool wants(std::uint32_t topic) const { return viewer_.subscription(topic).has_value(); }
  void publish(std::uint32_t topic, std::uint64_t received_ns, const SharedText& json);
  void add_topic(std::uint32_t topic);
  void remove_topic(std::uint32_t topic);
  /// Reports to the viewer how many messages it has missed, if more than at the last call.
  void report_drops();
  /// Queues a text ahead of all data.
  void say(std::string text);
  std::uint64_t id() const noexcept { return viewer_.id(); }
  std::uint64_t dropped() const noexcept { return queue_.dropped(); }

 private:
  void read();
  void on_message(const boost::beast::error_code& error);
  /// Removes and returns the next frame. News of topics and other frames alternate, so that neither blocks the other.
  std::optional<OutgoingFrame> next();
  void send();
  void end();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::beast::flat_buffer incoming_;
  ServerShared& shared_;
  Viewer viewer_;
  SendQueue queue_;
  TopicNews news_;
  bool news_are_next_ = false;
  std::optional<OutgoingFrame> sending_;
  std::uint64_t reported_drops_ = 0;
};

}  // namespace strainwave
