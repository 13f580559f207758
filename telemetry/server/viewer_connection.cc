// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/server/viewer_connection.h"

#include <fmt/format.h>

#include <chrono>

#include "base/printable.h"
#include "telemetry/steady_time.h"

namespace strainwave {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

// A viewer that answers no ping for this long is gone.
constexpr auto kIdle_s = std::chrono::seconds(30);
constexpr auto kHandshake_s = std::chrono::seconds(10);
// The system's send buffer adds to the bound of the queue.
constexpr int kSystemBuffer = 256 * 1024;

}  // namespace

ViewerConnection::ViewerConnection(beast::tcp_stream&& stream, ServerShared& shared, bool own_page)
    : stream_(std::move(stream)),
      shared_(shared),
      viewer_(Acting::Page{++shared.viewers_so_far, own_page}, shared.acting) {
  stream_.read_message_max(Viewer::kLongestMessage);
}

void ViewerConnection::start(const beast::http::request<beast::http::empty_body>& request,
                             std::string_view subprotocol) {
  beast::error_code ignored;
  auto& tcp = beast::get_lowest_layer(stream_);
  tcp.expires_never();  // the WebSocket has its own time-outs
  tcp.socket().set_option(boost::asio::socket_base::send_buffer_size(kSystemBuffer), ignored);
  tcp.socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  stream_.set_option(websocket::stream_base::timeout{kHandshake_s, kIdle_s, true});
  stream_.set_option(websocket::stream_base::decorator(
      [name = std::string(subprotocol)](websocket::response_type& response) {
        response.set(beast::http::field::sec_websocket_protocol, name);
      }));
  stream_.async_accept(request, [self = shared_from_this()](const beast::error_code& error) {
    if (error) return self->end();
    self->shared_.viewers.insert(self);
    self->say(server_info(self->shared_.session, self->viewer_.may_act()));
    self->shared_.topics.visit([&](const Topic& topic) { self->news_.offer(topic.id); });
    self->send();
    self->read();
  });
}

void ViewerConnection::publish(std::uint32_t topic, std::uint64_t received_ns, const SharedText& json) {
  const auto subscription = viewer_.subscription(topic);
  if (!subscription) return;
  queue_.push_data(message_head(*subscription, received_ns), json);
  send();
}

void ViewerConnection::add_topic(std::uint32_t topic) {
  news_.offer(topic);
  send();
}

void ViewerConnection::remove_topic(std::uint32_t topic) {
  viewer_.forget(topic);
  news_.withdraw(topic);
  send();
}

void ViewerConnection::report_drops() {
  if (queue_.dropped() == reported_drops_) return;
  reported_drops_ = queue_.dropped();
  say(status(StatusLevel::kWarning,
             counted(reported_drops_, "message") + " had to be dropped: this connection is too slow",
             "dropped"));
}

void ViewerConnection::read() {
  stream_.async_read(incoming_, [self = shared_from_this()](const beast::error_code& error, std::size_t) {
    self->on_message(error);
  });
}

void ViewerConnection::on_message(const beast::error_code& error) {
  if (error) return end();
  std::optional<std::string> answer;
  if (stream_.got_text()) {
    const auto bytes = incoming_.cdata();
    answer =
        viewer_.take({static_cast<const char*>(bytes.data()), bytes.size()}, shared_.topics, steady_now_s());
  } else {
    answer = status(StatusLevel::kError, "this server accepts no published messages", "refused");
  }
  incoming_.consume(incoming_.size());
  if (answer) say(std::move(*answer));
  if (stream_.is_open()) read();
}

void ViewerConnection::say(std::string text) {
  if (!queue_.push_control(std::move(text))) return end();
  send();
}

std::optional<OutgoingFrame> ViewerConnection::next() {
  const bool news_first = news_are_next_ || queue_.waiting_bytes() == 0;
  news_are_next_ = !news_first;
  if (news_first)
    if (auto text = news_.pop(shared_.topics))
      return OutgoingFrame{std::nullopt, std::make_shared<const std::string>(std::move(*text))};
  return queue_.pop();
}

void ViewerConnection::send() {
  if (sending_ || !stream_.is_open()) return;
  sending_ = next();
  if (!sending_) return;
  stream_.text(!sending_->head.has_value());
  const std::array<boost::asio::const_buffer, 2> buffers{
      sending_->head ? boost::asio::buffer(*sending_->head) : boost::asio::const_buffer(),
      boost::asio::buffer(*sending_->body)};
  stream_.async_write(buffers, [self = shared_from_this()](const beast::error_code& error, std::size_t) {
    self->sending_.reset();
    if (error) return self->end();
    self->send();
  });
}

// Pending operations end with an error and call this again.
void ViewerConnection::end() {
  if (shared_.viewers.erase(shared_from_this()) > 0) shared_.dropped_before += queue_.dropped();
  beast::error_code ignored;
  beast::get_lowest_layer(stream_).socket().close(ignored);
}

}  // namespace strainwave
