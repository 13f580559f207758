// SPDX-License-Identifier: BSD-3-Clause
// A conversation with one daemon: it learns the session from the published state, sends an order, and repeats
// the order until it is acknowledged. Everything waits on one thread and ends in time. Not real-time.
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
  double timeout_s = 2.0;  ///< of each wait: for a state, for an acknowledgement, for a change of mode
  std::filesystem::path key_file = {};  ///< secret key to sign orders with; empty: unsigned
  bool all_prefixes = false;            ///< status and watch show every daemon that is heard
  bool names_commands = false;          ///< errors name commands of strainwavectl, not calls of the library
};

class Client {
 public:
  /// Number of attempts, each with a higher sequence, when another program with the same key was ahead.
  static constexpr int kAttempts = 3;

  Client(Connection& connection, const ClientOptions& options);

  const ClientOptions& options() const noexcept { return options_; }
  Connection& connection() noexcept { return connection_; }
  const StateView& states() const noexcept { return states_; }

  /// The latest view of `joint`, or null if no message of it was received.
  const JointView* find(const std::string& joint) const { return states_.find(options_.prefix, joint); }

  /// The call or command that an error recommends, in the user's interface: "Joint::clear_fault()", or "strainwavectl clear-fault elbow".
  std::string advice(std::string_view call, std::string_view command, const std::string& joint) const;

  /// Waits until `joint` is heard; its view lasts as long as this client. Throws ClientError (no answer) that lists the joints heard instead.
  const JointView& wait_for_joint(const std::string& joint);

  /// Waits until a joint is heard, then a little longer for the other joints of the daemon. Throws like wait_for_joint().
  std::vector<std::string> wait_for_joints();

  /// The joints heard under the prefix, or under all prefixes with all_prefixes; sorted.
  std::vector<JointName> heard() const;
  /// The same after waiting as wait_for_joints() does.
  std::vector<JointName> wait_for_heard();

  /// Sends `message` (setpoint_v1, command_v1, gain_table_v1 or inject_v1) to `joint` on the channel of `kind` and waits for
  /// the answer. Throws ClientError when the joint is not heard or no answer comes. The message and its repetitions quote the
  /// latest state. The daemon refuses it if that state is over a second old, or if the joint stopped or faulted since.
  template <typename Message>
  Answer request(const std::string& joint, std::string_view kind, const Message& message) {
    Message prepared = message;
    return request(joint, kind, prepared, [](Message&) {});
  }

  /// The same for a message that depends on its time of sending: every attempt first calls `prepare` with it.
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

  /// The same for a stop, which must go out even when the joint is not heard. It does not wait for a state. With an unusable key it goes out
  /// unsigned. The daemon obeys an unsigned stop, too, but only a signature makes its answer certain.
  template <typename Message>
  Answer request_unseen(const std::string& joint, std::string_view kind, const Message& message) {
    const JointView* view = find(joint);
    const Quote quote = view != nullptr ? quote_of(view->state) : Quote{};
    Answer answer = exchange(joint, sender_.seal_stop(channel(options_.prefix, joint, kind), message, quote),
                             PendingOrder::stop_patience(options_.timeout_s));
    if (find(joint) != nullptr) stopped_[joint] = find(joint)->messages;
    return answer;
  }

  /// Returns a number for a new stream of setpoints.
  std::int64_t new_stream() noexcept { return sender_.new_stream(); }

  /// Sends `message`, one of a stream, once and without waiting, to a joint that is heard. The daemon answers
  /// only to refuse it, see take_refusal().
  template <typename Message>
  void send(const std::string& joint, std::string_view kind, const Message& message) {
    const Quote quote = quote_of(wait_for_joint(joint).state);
    const SealedMessage sealed = sender_.seal(channel(options_.prefix, joint, kind), message, quote);
    connection_.publish(sealed.channel, sealed.bytes);
    sent_[sent_count_++ % sent_.size()] = sealed.sequence;
  }

  /// Returns the oldest refusal of a message of send() that was not yet taken.
  std::optional<Answer> take_refusal();
  bool has_refusals() const noexcept { return !refusals_.empty(); }
  /// From now on ignores answers to earlier messages of send().
  void forget_sent() noexcept;

  /// Dispatches all messages received so far.
  void catch_up();

  /// Dispatches messages until `done()` is true or the deadline passes. Returns whether it is done. Throws ClientError (interrupted).
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
  std::optional<PendingOrder> awaited_;  ///< the order that waits for its answer
  std::optional<ack_v1> ack_;
  std::map<std::string, std::int64_t>
      stopped_;  ///< number of states received from a joint when its last stop was answered
  std::array<std::int64_t, 256> sent_{};  ///< sequences of the latest messages of send()
  std::size_t sent_count_ = 0;
  std::deque<Answer> refusals_;
  Subscription acknowledgements_;
};

}  // namespace strainwave
