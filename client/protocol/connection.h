// SPDX-License-Identifier: BSD-3-Clause
// The client's access to LCM's network: subscriptions, publishing, waiting. It handles bytes and channels,
// not messages. It receives with Strainwave's own receiver (transport/), because a crafted datagram ends any
// program that receives with LCM's library. That library only sends here. It uses one thread; after
// read_ahead() a second thread reads the network. Not real-time.
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

/// A received message, valid while its handler runs.
struct ReceivedMessage {
  const std::string& channel;
  std::span<const std::uint8_t> bytes;
  std::int64_t received_us = 0;  ///< since the epoch, by this computer's clock
  LcmSource from = {};           ///< empty with memq://
};

class Connection;

/// Ends the subscription in its destructor. Must not outlive the connection.
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
  /// Number of messages that may wait for handle(). Later ones wait in the system's buffer, and are lost when
  /// that is full.
  static constexpr std::size_t kQueueCapacity = 4096;

  /// Joins the network of `lcm_url`, udpm://GROUP:PORT?ttl=N. memq:// stays within this object, without a
  /// network. Throws ClientError (LCM unavailable) that names the remedy.
  explicit Connection(const std::string& lcm_url);

  const std::string& url() const noexcept { return url_; }

  /// From handle(), calls `method` of `handler` for each message whose whole channel matches `pattern` (a
  /// regular expression). The subscription ends with the returned object.
  template <typename Handler>
  [[nodiscard]] Subscription subscribe(const std::string& pattern,
                                       void (Handler::*method)(const ReceivedMessage& message),
                                       Handler* handler) {
    return {subscriptions_, {std::regex(pattern), [handler, method](const ReceivedMessage& message) {
                               (handler->*method)(message);
                             }}};
  }

  /// Throws ClientError when LCM does not accept the message.
  void publish(const std::string& channel, std::span<const std::uint8_t> bytes);
  /// Returns publish() as a function, which must not outlive the connection.
  auto publisher() {
    return
        [this](const std::string& channel, std::span<const std::uint8_t> bytes) { publish(channel, bytes); };
  }

  /// From now on a separate thread reads the network ahead of handle(), within a limit of memory, and
  /// missing() counts. Recorders use it, because they need every message. With memq:// nothing changes.
  void read_ahead();
  /// Number of messages that `from` sent since read_ahead() and that were lost, in the network or in this program.
  std::uint64_t missing(const LcmSource& from) const noexcept { return missing_.of(from); }
  /// Number of lost datagrams for which read_ahead() had no room.
  std::uint64_t without_room() const noexcept;
  /// The size of the socket's receive queue: granted by the system, and requested.
  struct SocketQueue {
    int given_bytes = 0;
    int asked_bytes = 0;
  };
  SocketQueue socket_queue() const noexcept;

  /// Waits up to `timeout_ms`, half a second at most, for messages and dispatches one. Returns false if none came or a signal interrupted the wait.
  bool handle(int timeout_ms);

 private:
  struct Network {
    Network(const std::string& lcm_url, const MulticastAddress& address);

    lcm::LCM sender;
    LcmSocket socket;
    LcmReassembly reassembly;
    std::optional<LcmReadAhead> ahead;  ///< destroyed before the socket, which it reads
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
  std::unique_ptr<Network> network_;  ///< null with memq://
  Subscription::Entries subscriptions_;
  std::deque<Waiting> waiting_;
  MissingMessages missing_;
};

}  // namespace strainwave
