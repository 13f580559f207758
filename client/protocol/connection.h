// SPDX-License-Identifier: BSD-3-Clause
// The client's way to LCM's network: subscriptions, publishing, waiting. Knows bytes and channels, not messages. What comes in is
// read by our own receiver (transport/): a crafted datagram ends any program that receives with LCM's library, which only
// sends here. One thread, and with read_ahead() one that reads
// the network for it. Not real-time.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <list>
#include <memory>
#include <optional>
#include <regex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "transport/lcm_read_ahead.h"
#include "transport/lcm_reassembly.h"
#include "transport/lcm_socket.h"
#include "transport/missing_messages.h"

namespace strainwave {

/// A message as it came, valid while its handler runs.
struct ReceivedMessage {
  const std::string& channel;
  std::span<const std::uint8_t> bytes;
  std::int64_t received_us = 0;  ///< since the epoch, by our own clock
  LcmSource from = {};           ///< nobody with memq://
};

class Connection;

/// Ends a subscription with its owner. Must not outlive the connection.
class Subscription {
 public:
  ~Subscription();
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

 private:
  friend class Connection;
  struct Entry {
    std::regex pattern;
    std::function<void(const ReceivedMessage&)> handler;
  };
  using Entries = std::list<Entry>;
  Subscription(Entries& entries, Entry entry)
      : entries_(&entries), own_(entries.insert(entries.end(), std::move(entry))) {}

  Entries* entries_;
  Entries::iterator own_;
};

class Connection {
 public:
  /// Messages that may wait until handle() is called; what comes then waits in the system's buffer, and is lost
  /// when that is full.
  static constexpr std::size_t kQueueCapacity = 4096;

  /// Joins the network of `lcm_url`, udpm://GROUP:PORT?ttl=N; memq:// is none, but this object alone. Throws ClientError (LCM
  /// unavailable) that says what to do.
  explicit Connection(const std::string& lcm_url);

  const std::string& url() const noexcept { return url_; }

  /// Calls `method` of `handler` from handle() for each message whose channel matches `pattern` as a whole (a
  /// regular expression), as long as the returned object lives.
  template <typename Handler>
  [[nodiscard]] Subscription subscribe(const std::string& pattern,
                                       void (Handler::*method)(const ReceivedMessage& message),
                                       Handler* handler) {
    return {subscriptions_, {std::regex(pattern), [handler, method](const ReceivedMessage& message) {
                               (handler->*method)(message);
                             }}};
  }

  /// Throws ClientError when LCM does not take the message.
  void publish(const std::string& channel, std::span<const std::uint8_t> bytes);
  /// publish() as a function, which must not outlive the connection.
  auto publisher() {
    return
        [this](const std::string& channel, std::span<const std::uint8_t> bytes) { publish(channel, bytes); };
  }

  /// From now on a separate thread reads the network, ahead of handle() by as much as memory has room for, and missing() counts.
  /// This is for recorders, which need every message. With memq:// nothing changes.
  void read_ahead();
  /// Messages that `from` sent since then and that did not come; all of the network's losses and ours.
  std::uint64_t missing(const LcmSource& from) const noexcept { return missing_.of(from); }
  /// Of them, in datagrams: those for which read_ahead() had no room left.
  std::uint64_t without_room() const noexcept;
  /// The system's queue before the socket: what it gave, and what was asked for.
  struct SocketQueue {
    int given_bytes = 0;
    int asked_bytes = 0;
  };
  SocketQueue socket_queue() const noexcept;

  /// Waits up to `timeout_ms`, half a second at most, for messages and dispatches one. False: there was none, or a signal came.
  bool handle(int timeout_ms);

 private:
  struct Network {
    Network(const std::string& lcm_url, const MulticastAddress& address);

    lcm::LCM sender;
    LcmSocket socket;
    LcmReassembly reassembly;
    std::optional<LcmReadAhead> ahead;  ///< after the socket, which it reads
  };
  struct Waiting {
    std::string channel;
    std::vector<std::uint8_t> bytes;
    std::int64_t received_us = 0;
    LcmSource from;
  };
  void wait(int timeout_ms) const;
  void take_what_came();
  std::size_t receive();
  void take(const LcmSource& from, std::int64_t received_us, std::span<const std::uint8_t> datagram);
  void keep(Waiting message);

  std::string url_;
  std::unique_ptr<Network> network_;  ///< none with memq://
  Subscription::Entries subscriptions_;
  std::deque<Waiting> waiting_;
  MissingMessages missing_;
};

}  // namespace strainwave
