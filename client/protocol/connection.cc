// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/connection.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/utime.h"
#include "lcmtypes/multicast_check.h"
#include "lcmtypes/wire.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

constexpr std::string_view kWithoutNetwork = "memq://";

/// Holds one second of 64 joints at 200 Hz. A starved gateway later sends its whole ring at once: 8192
/// states, over half of that second. A busy machine may also leave the recorder without a processor.
constexpr int kSocketQueueBytes = 8 << 20;

/// About eight seconds of those messages: a disk may take so long while it writes the files of a concurrent build.
constexpr std::size_t kReadAheadBytes = 64 << 20;

NoAnswer unavailable(const std::string& lcm_url, const std::string& why) {
  return NoAnswer("LCM is not available on '" + lcm_url + "': " + why);
}

/// Returns the multicast address of the URL after a check that datagrams come back from it. LCM's own error messages name no remedy.
MulticastAddress checked(const std::string& lcm_url) {
  const auto address = parse_udpm_url(lcm_url);
  if (!address)
    throw unavailable(lcm_url, std::string("it must have the form udpm://GROUP:PORT?ttl=N; check --lcm-url, "
                                           "or LCM_DEFAULT_URL in the environment; the usual one is ") +
                                   kUsualLcmUrl);
  if (const auto problem = find_multicast_problem(lcm_url)) throw unavailable(lcm_url, *problem);
  return *address;
}

bool matches(const std::string& channel, const std::regex& pattern) {
  return std::regex_match(channel, pattern);
}

}  // namespace

Subscription::~Subscription() {
  entries_->erase(own_);
}

Connection::Network::Network(const std::string& lcm_url, const MulticastAddress& address)
    : sender(lcm_url),
      socket(address, largest_datagram(kLargestMessageBytes), kSocketQueueBytes),
      reassembly(kLargestMessageBytes) {
  if (!sender.good()) throw std::system_error(ENETUNREACH, std::generic_category(), "opening LCM's sender");
}

Connection::Connection(const std::string& lcm_url) : url_(lcm_url) {
  if (url_ == kWithoutNetwork) return;
  const MulticastAddress address = checked(url_);
  try {
    network_ = std::make_unique<Network>(url_, address);
  } catch (const std::system_error& error) {
    throw unavailable(url_, error.what());
  }
}

void Connection::publish(const std::string& channel, std::span<const std::uint8_t> bytes) {
  if (!network_) return keep({channel, {bytes.begin(), bytes.end()}, utime_now(), {}});
  if (network_->sender.publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size())) != 0) {
    throw NoAnswer("LCM could not send a message on " + channel + ": is the network of " + url_ + " up?");
  }
}

bool Connection::handle(int timeout_ms) {
  take_what_came();
  if (waiting_.empty()) {
    wait(timeout_ms);
    take_what_came();
  }
  if (waiting_.empty()) return false;
  const Waiting next = std::move(waiting_.front());
  waiting_.pop_front();
  for (const Subscription::Entry& entry : subscriptions_)
    if (matches(next.channel, entry.pattern))
      entry.handler({next.channel, next.bytes, next.received_us, next.from});
  return true;
}

void Connection::wait(int timeout_ms) const {
  const int readable = !network_         ? -1
                       : network_->ahead ? network_->ahead->descriptor()
                                         : network_->socket.descriptor();
  pollfd descriptor{readable, POLLIN, 0};
  if (::poll(&descriptor, 1, network_ ? std::min(timeout_ms, LcmSocket::kLookEvery_ms) : timeout_ms) < 0 &&
      errno != EINTR)
    throw NoAnswer("LCM stopped working on " + url_);
}

void Connection::read_ahead() {
  if (!network_ || network_->ahead) return;
  missing_.clear();
  network_->ahead.emplace(network_->socket, kReadAheadBytes);
}

std::uint64_t Connection::without_room() const noexcept {
  return network_ && network_->ahead ? network_->ahead->dropped() : 0;
}

Connection::SocketQueue Connection::socket_queue() const noexcept {
  return network_ ? SocketQueue{network_->socket.queue_bytes(), kSocketQueueBytes} : SocketQueue{};
}

void Connection::take_what_came() {
  if (!network_) return;
  while (waiting_.size() < kQueueCapacity && receive() == LcmSocket::kBatch) {
  }
}

std::size_t Connection::receive() {
  if (network_->ahead)
    return network_->ahead->receive(
        [this](const LcmSource& from, std::int64_t received_us, std::span<const std::uint8_t> datagram) {
          take(from, received_us, datagram);
        });
  network_->socket.follow_route();
  return network_->socket.receive([this](const LcmSource& from, std::span<const std::uint8_t> datagram) {
    take(from, utime_now(), datagram);
  });
}

void Connection::take(const LcmSource& from, std::int64_t received_us,
                      std::span<const std::uint8_t> datagram) {
  const auto message = network_->reassembly.take(from, datagram);
  if (!message) return;
  if (network_->ahead) missing_.heard(from, message->sequence);
  keep({std::string(message->channel), {message->bytes.begin(), message->bytes.end()}, received_us, from});
}

// Keeps only messages with a subscription.
void Connection::keep(Waiting message) {
  const bool wanted = std::ranges::any_of(subscriptions_, [&](const Subscription::Entry& entry) {
    return matches(message.channel, entry.pattern);
  });
  if (wanted) waiting_.push_back(std::move(message));
}

}  // namespace strainwave
