// SPDX-License-Identifier: BSD-3-Clause
// Shared by Joint and its Streams: one connection, the joint's messages, and a thread that receives them. The
// thread works in the background, so that no message waits in the system's queue. Not real-time.
#pragma once

#include <deque>
#include <mutex>
#include <strainwave/limits_v1.hpp>
#include <string>
#include <thread>
#include <vector>

#include "client/protocol/client.h"
#include "client/protocol/connection.h"
#include "client/protocol/cycle_clock.h"
#include "client/protocol/published_limits.h"
#include "strainwave/joint.h"

namespace strainwave {

class JointLink {
 public:
  /// Largest number of states that wait for a caller of states(). If the caller is too slow, the oldest are lost.
  static constexpr std::size_t kInbox = 4096;
  using Inbox = std::deque<State>;

  /// Throws InvalidInput, NoAnswer.
  JointLink(const std::string& name, const JointOptions& options);

  const std::string& name() const noexcept { return name_; }

  /// Hold this lock during the use of any member below.
  std::unique_lock<std::recursive_mutex> lock() { return std::unique_lock(mutex_); }

  Client& client() noexcept { return client_; }
  const Connection& connection() const noexcept { return connection_; }
  /// The latest received state; waits for the first. Throws NoAnswer when there is none, or when it is too old.
  const JointView& view();
  const limits_v1& limits();
  /// "elbow: lost contact with strainwaved: no state for 3.2 s". `what` is the part between the name and the time.
  std::string silence(const std::string& what) const;
  /// The present cycle of the daemon, see CycleClock. At least one state must have been received.
  double cycle_now(double period_s) const { return clock_.cycle_at(now(), period_s); }

  void open(Inbox& inbox) { inboxes_.push_back(&inbox); }
  void close(const Inbox& inbox) { std::erase(inboxes_, &inbox); }

 private:
  void on_state(const ReceivedMessage& message);
  void listen(const std::stop_token& end);

  std::string name_;
  Connection connection_;
  Client client_;
  PublishedLimits limits_;
  CycleClock clock_;
  std::int64_t session_id_ = 0;
  std::vector<Inbox*> inboxes_;
  Subscription states_;
  std::recursive_mutex mutex_;
  std::jthread listener_;  ///< the last member, so that its thread ends first
};

/// Throws InvalidInput unless both joints belong to the same daemon, because each daemon counts its own
/// cycles. `who`: "the joints of a path".
void require_same_daemon(JointLink& joint, JointLink& other, const std::string& who);

/// Returns `value` if it is finite and `is_allowed`; otherwise throws InvalidInput. `joint` is the joint it
/// belongs to. `key`, if given, is the configuration key of the daemon that sets the limit.
double checked_number(const std::string& joint, const std::string& name, double value,
                      const std::string& allowed, bool is_allowed = true, const std::string& key = "");

}  // namespace strainwave
