// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/server/server.h"

#include <chrono>
#include <csignal>

#include "base/input_error.h"
#include "base/utime.h"
#include "telemetry/server/opening_connection.h"
#include "telemetry/server/viewer_connection.h"
#include "telemetry/steady_time.h"

namespace strainwave {

namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using boost::system::error_code;

constexpr auto kReport_s = std::chrono::seconds(1);

}  // namespace

class TelemetryServer::Network {
 public:
  Network(const ListenAddress& address, AccessRules rules, const Topics& topics,
          std::function<SharedText(bool packed)> metrics, Acting* acting)
      : acceptor_(context_),
        signals_(context_, SIGINT, SIGTERM),
        report_(context_),
        shared_{std::move(rules),
                topics,
                std::move(metrics),
                acting,
                WebPage(acting != nullptr),
                std::to_string(utime_now()),
                {},
                {},
                0,
                0,
                0} {
    const tcp::endpoint endpoint(asio::ip::make_address(address.host), address.port);
    try {
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw InputError("--listen: cannot listen on " + address.host + ", port " +
                       std::to_string(address.port) + ": " + error.code().message());
    }
  }

  void run(int descriptor, const std::function<void()>& on_readable, const std::function<void()>& on_second) {
    asio::posix::stream_descriptor lcm(context_, descriptor);
    signals_.async_wait([this](const error_code&, int) { context_.stop(); });
    wait_for(lcm, on_readable);
    accept();
    report(on_readable, on_second);
    if (shared_.acting != nullptr) act();
    context_.run();
    lcm.release();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  ServerShared& shared() noexcept { return shared_; }

 private:
  void wait_for(asio::posix::stream_descriptor& lcm, const std::function<void()>& on_readable) {
    lcm.async_wait(asio::posix::stream_descriptor::wait_read, [&, this](const error_code& error) {
      if (error) return;
      on_readable();
      wait_for(lcm, on_readable);
    });
  }

  void accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) open(std::move(socket));
      // Without a free descriptor, every further attempt fails at once.
      if (error) return wait_and_accept();
      accept();
    });
  }

  void wait_and_accept() {
    pause_.expires_after(kReport_s);
    pause_.async_wait([this](const error_code& error) {
      if (!error) accept();
    });
  }

  void open(tcp::socket&& socket) {
    auto& opening = shared_.opening;
    if (opening.size() >= TelemetryServer::kMaxOpening) {
      if (const auto oldest = opening.front().lock()) oldest->end();
      opening.pop_front();
      ++shared_.refused;
    }
    const auto connection = std::make_shared<OpeningConnection>(std::move(socket), shared_);
    opening.push_back(connection);
    connection->start();
  }

  // Also receives once a second, so that a change of the network is noticed even without messages.
  void report(const std::function<void()>& on_readable, const std::function<void()>& on_second) {
    report_.expires_after(kReport_s);
    report_.async_wait([&, this](const error_code& error) {
      if (error) return;
      on_readable();
      on_second();
      // A viewer that is disconnected meanwhile leaves the set.
      const std::set<std::shared_ptr<ViewerConnection>> viewers = shared_.viewers;
      for (const auto& viewer : viewers) viewer->report_drops();
      report(on_readable, on_second);
    });
  }

  void act() {
    tick_.expires_after(std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(Acting::kTick_s)));
    tick_.async_wait([this](const error_code& error) {
      if (error) return;
      shared_.acting->tick(steady_now_s());
      act();
    });
  }

  asio::io_context context_;
  tcp::acceptor acceptor_;
  asio::signal_set signals_;
  asio::steady_timer report_;
  asio::steady_timer pause_{context_};
  asio::steady_timer tick_{context_};
  ServerShared shared_;
};

TelemetryServer::TelemetryServer(const ListenAddress& address, AccessRules rules, const Topics& topics,
                                 std::function<SharedText(bool packed)> metrics, Acting* acting)
    : network_(std::make_unique<Network>(address, std::move(rules), topics, std::move(metrics), acting)) {}

TelemetryServer::~TelemetryServer() = default;

std::uint16_t TelemetryServer::port() const {
  return network_->port();
}

void TelemetryServer::add_topic(std::uint32_t topic) {
  const auto viewers = network_->shared().viewers;
  for (const auto& viewer : viewers) viewer->add_topic(topic);
}

void TelemetryServer::remove_topic(std::uint32_t topic) {
  const auto viewers = network_->shared().viewers;
  for (const auto& viewer : viewers) viewer->remove_topic(topic);
}

bool TelemetryServer::is_wanted(std::uint32_t topic) const {
  for (const auto& viewer : network_->shared().viewers)
    if (viewer->wants(topic)) return true;
  return false;
}

void TelemetryServer::publish(std::uint32_t topic, std::int64_t received_us, std::string json) {
  const auto body = shared_text(std::move(json));
  for (const auto& viewer : network_->shared().viewers)
    viewer->publish(topic, static_cast<std::uint64_t>(received_us) * 1000U, body);
}

void TelemetryServer::say(std::uint64_t viewer, std::string text) {
  const auto viewers = network_->shared().viewers;
  for (const auto& one : viewers)
    if (one->id() == viewer) return one->say(std::move(text));
}

ServerCounts TelemetryServer::counts() const {
  const ServerShared& shared = network_->shared();
  ServerCounts counts{shared.viewers.size(), shared.dropped_before, shared.refused};
  for (const auto& viewer : shared.viewers) counts.dropped_messages += viewer->dropped();
  return counts;
}

void TelemetryServer::run(int descriptor, const std::function<void()>& on_readable,
                          const std::function<void()>& on_second) {
  network_->run(descriptor, on_readable, on_second);
}

}  // namespace strainwave
