// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/server/opening_connection.h"

#include <chrono>

#include "telemetry/compression.h"
#include "telemetry/server/viewer_connection.h"

namespace strainwave {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr auto kLongestRequest_s = std::chrono::seconds(10);
constexpr std::uint32_t kLargestHeader = 8192;
/// The page takes scripts and styles only from this server, and no other page may frame it. uPlot sets styles by attribute.
constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; connect-src 'self' ws: wss:; "
    "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

}  // namespace

OpeningConnection::OpeningConnection(boost::asio::ip::tcp::socket&& socket, ServerShared& shared)
    : stream_(std::move(socket)), shared_(shared) {
  parser_.header_limit(kLargestHeader);
}

void OpeningConnection::start() {
  stream_.expires_after(kLongestRequest_s);
  http::async_read(
      stream_, buffer_, parser_,
      [self = shared_from_this()](const beast::error_code& error, std::size_t) { self->on_request(error); });
}

void OpeningConnection::end() {
  beast::error_code ignored;
  stream_.socket().close(ignored);
}

void OpeningConnection::on_request(const beast::error_code& error) {
  shared_.opening.remove_if([&](const auto& other) { return other.expired() || other.lock().get() == this; });
  if (error == http::error::header_limit || error == http::error::unexpected_body)
    return refuse(Status::bad_request, "the request is too long");
  if (!error) answer(parser_.get());
}

void OpeningConnection::answer(const Request& request) {
  const std::string_view target = view(request.target());
  // The page's files contain no data. Its data come through the WebSocket, which is judged below.
  const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
  if (const WebPage::File* file = shared_.page.find(path_of(target));
      file != nullptr && reads && !beast::websocket::is_upgrade(request))
    return respond(Status::ok, file->type.c_str(), file->text);
  const RequestFacts facts{target, view(request[http::field::authorization]),
                           view(request[http::field::origin]), view(request[http::field::host])};
  switch (judge(facts, shared_.rules)) {
    case Access::kNoToken:
      return refuse(Status::unauthorized,
                    "a token is required: the header 'Authorization: Bearer TOKEN', or ?token=TOKEN");
    case Access::kForeignPage:
      return refuse(Status::forbidden,
                    "this page, or this name of the machine, is not allowed: see --origin and --token-file");
    case Access::kGranted:
      break;
  }
  if (beast::websocket::is_upgrade(request)) return become_viewer(request, is_from_own_page(facts));
  if (!reads) return refuse(Status::method_not_allowed, "only GET and HEAD are answered");
  if (path_of(target) == "/metrics") {
    const bool packed = takes_gzip(view(request[http::field::accept_encoding]));
    if (packed) response_.set(http::field::content_encoding, "gzip");
    response_.set(http::field::vary, "Accept-Encoding");
    return respond(Status::ok, "text/plain; version=0.0.4; charset=utf-8", shared_.metrics(packed));
  }
  refuse(Status::not_found, "this server has / (the page), /metrics (Prometheus) and ws:// (Foxglove)");
}

void OpeningConnection::become_viewer(const Request& request, bool own_page) {
  const auto subprotocol = choose_subprotocol(view(request[http::field::sec_websocket_protocol]));
  if (!subprotocol)
    return refuse(Status::bad_request, "the subprotocol must be foxglove.sdk.v1 or foxglove.websocket.v1");
  if (shared_.viewers.size() >= TelemetryServer::kMaxViewers)
    return refuse(Status::service_unavailable, "too many viewers are connected");
  std::make_shared<ViewerConnection>(std::move(stream_), shared_, own_page)->start(request, *subprotocol);
}

void OpeningConnection::refuse(Status status, const std::string& why) {
  ++shared_.refused;
  respond(status, "text/plain; charset=utf-8", shared_text(why + "\n"));
}

void OpeningConnection::respond(Status status, const char* type, SharedText body) {
  response_.result(status);
  response_.set(http::field::content_type, type);
  response_.set("Content-Security-Policy", kPagePolicy);
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set(http::field::cache_control, "no-cache");
  if (status == Status::unauthorized) response_.set(http::field::www_authenticate, "Bearer");
  response_.keep_alive(false);
  body_ = std::move(body);
  response_.body() = {body_->data(), body_->size()};
  response_.prepare_payload();
  if (parser_.get().method() == http::verb::head) response_.body() = {};  // the header still has the length
  stream_.expires_after(kLongestRequest_s);
  http::async_write(stream_, response_, [self = shared_from_this()](const beast::error_code&, std::size_t) {
    beast::error_code ignored;
    self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  });
}

}  // namespace strainwave
