// SPDX-License-Identifier: BSD-3-Clause
// A new connection up to its only request: a file of the page, the metrics, a refusal, or a viewer. A viewer
// continues as ViewerConnection. Not real-time.
#pragma once

#include "telemetry/server/shared.h"

namespace strainwave {

class OpeningConnection : public std::enable_shared_from_this<OpeningConnection> {
 public:
  OpeningConnection(boost::asio::ip::tcp::socket&& socket, ServerShared& shared);

  void start();
  /// Closes the connection to make room for others.
  void end();

 private:
  using Status = boost::beast::http::status;
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;

  void on_request(const boost::beast::error_code& error);
  void answer(const Request& request);
  void become_viewer(const Request& request, bool own_page);
  void respond(Status status, const char* type, SharedText body);
  void refuse(Status status, const std::string& why);

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  boost::beast::http::request_parser<boost::beast::http::empty_body> parser_;
  SharedText body_;  ///< text of the response
  boost::beast::http::response<boost::beast::http::span_body<const char>> response_;
  ServerShared& shared_;
};

}  // namespace strainwave
