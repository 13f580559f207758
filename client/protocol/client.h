// SPDX-License-Identifier: BSD-3-Clause
// A conversation with one daemon: learn its session from the state it publishes, send an order, repeat it
// until it is acknowledged. Everything waits on one thread and ends in time. Not real-time.
#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <strainwave/ack_v1.hpp>
#include <string>
#include <vector>

#include "client/protocol/connection.h"
#include "client/protocol/pending_order.h"
#include "client/protocol/sender.h"
#include "client/protocol/state_view.h"
#include "lcmtypes/channels.h"

namespace strainwave {

/// A joint on the LCM network.
struct JointName {
  std::string prefix;
  std::string joint;
};

struct ClientOptions {
  std::string prefix = "SW";
  double timeout_s =
      2.0;  ///< of every single wait: for a state, for an acknowledgement, for a change of mode
  std::filesystem::path key_file = {};  ///< secret key to sign orders with; empty: unsigned
  bool all_prefixes = false;    ///< what only looks (status, watch) looks at every daemon that is heard
  bool names_commands = false;  ///< errors advise commands of strainwavectl, not calls of the library
};

class Client {
 public:
  /// How often an order is sent with another sequence, when another program of its key was ahead.
  static constexpr int kAttempts = 3;

  Client(Connection& connection, const ClientOptions& options);

  const ClientOptions& options() const noexcept { return options_; }
  Connection& connection() noexcept { return connection_; }
  const StateView& states() const noexcept { return states_; }

  /// The latest view of `joint`, or null when nothing was heard of it.
  const JointView* find(const std::string& joint) const { return states_.find(options_.prefix, joint); }

  /// What an error tells its reader to do, in the words of what he uses: "Joint::clear_fault()", or "strainwavectl clear-fault elbow".
  std::string advice(std::string_view call, std::string_view command, const std::string& joint) const;

  /// Waits until `joint` is heard; its view lasts as long as this client. Throws ClientError (no answer) that says what is heard instead.
  const JointView& wait_for_joint(const std::string& joint);

  /// Waits until a joint is heard, then a little for the others of the daemon. Throws like wait_for_joint().
  std::vector<std::string> wait_for_joints();

  /// Joints that are heard of the prefix, or of all with all_prefixes; in order.
  std::vector<JointName> heard() const;
  /// The same after waiting as wait_for_joints() does.
  std::vector<JointName> wait_for_heard();

  /// Sends `message` (setpoint_v1, command_v1, gain_table_v1 or inject_v1) to `joint` on the channel of `kind` and waits
  /// for the answer. Throws ClientError when the joint is not heard or no answer comes. It quotes the latest state, also when it is
  /// repeated. So the daemon refuses it once that is a second old, or the joint was stopped or has faulted since.
  template <typename Message>
  Answer request(const std::string& joint, std::string_view kind, const Message& message) {
    Message prepared = message;
    return request(joint, kind, prepared, [](Message&) {});
  }

  /// The same for a message that depends on when it goes out: `prepare` is called with it before every attempt.
  template <typename Message, typename Prepare>
  Answer request(const std::string& joint, std::string_view kind, Message& message, const Prepare& prepare) {
    const Quote quote = quote_of(wait_until_settled(joint).state);
    Answer answer;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      prepare(message);
      SealedMessage sealed = sender_.seal(channel(options_.prefix, joint, kind), message, quote);
      const Patience patience = PendingOrder::patience(sealed.bytes.size(), options_.timeout_s);
      answer = exchange(joint, std::move(sealed), patience);
      if (answer.accepted || !rises_above(answer)) break;
    }
    return answer;
  }

  /// The same for an order that must go out even when nothing is heard of the joint: a stop. It does not wait for a state, and
  /// a key that cannot be used keeps nothing back; the signature only makes its answer sure.
  template <typename Message>
  Answer request_unseen(const std::string& joint, std::string_view kind, const Message& message) {
    const JointView* view = find(joint);
    const Quote quote = view != nullptr ? quote_of(view->state) : Quote{};
    Answer answer = exchange(joint, sender_.seal_stop(channel(options_.prefix, joint, kind), message, quote),
                             PendingOrder::stop_patience(options_.timeout_s));
    if (find(joint) != nullptr) stopped_[joint] = find(joint)->messages;
    return answer;
  }

  /// A number for a new stream of setpoints.
  std::int64_t new_stream() noexcept { return sender_.new_stream(); }

  /// Sends `message` to a joint that is heard, once and without waiting: one of a stream. Only a refusal of
  /// it is answered, see take_refusal().
  template <typename Message>
  void send(const std::string& joint, std::string_view kind, const Message& message) {
    const Quote quote = quote_of(wait_for_joint(joint).state);
    const SealedMessage sealed = sender_.seal(channel(options_.prefix, joint, kind), message, quote);
    connection_.publish(sealed.channel, sealed.bytes);
    sent_[sent_count_++ % sent_.size()] = sealed.sequence;
  }

  /// The daemon's oldest refusal of a message of send() that was not yet taken.
  std::optional<Answer> take_refusal();
  bool has_refusals() const noexcept { return !refusals_.empty(); }
  /// Answers to what send() sent before are dropped.
  void forget_sent() noexcept;

  /// Dispatches what has come so far.
  void catch_up();

  /// Dispatches messages until `done()` or the deadline; the last value of done(). Throws ClientError (interrupted).
  template <typename Done>
  bool wait_until(const Done& done, const Deadline& deadline) {
    while (!done()) {
      if (deadline.passed()) return false;
      handle(deadline.remaining_ms());
    }
    return true;
  }

 private:
  const JointView& wait_until_settled(const std::string& joint);
  bool rises_above(const Answer& refusal);
  Answer exchange(const std::string& joint, SealedMessage order, const Patience& patience);
  void handle(int timeout_ms);
  void on_ack(const ReceivedMessage& message);
  [[noreturn]] void explain_silence(const std::string& joint) const;

  Connection& connection_;
  ClientOptions options_;
  StateView states_;
  Sender sender_;
  std::optional<PendingOrder> awaited_;  ///< the order whose answer counts
  std::optional<ack_v1> ack_;
  std::map<std::string, std::int64_t>
      stopped_;                           ///< states of a joint that had come when its last stop was answered
  std::array<std::int64_t, 256> sent_{};  ///< sequences of the latest messages of send()
  std::size_t sent_count_ = 0;
  std::deque<Answer> refusals_;
  Subscription acknowledgements_;
};

}  // namespace strainwave
