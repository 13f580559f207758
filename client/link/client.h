// A conversation with one daemon: learn its session from the state it publishes, send an order, repeat it
// until it is acknowledged. Everything waits on one thread and ends in time. Not real-time.
#pragma once

#include <filesystem>
#include <optional>
#include <strainwave/ack_v1.hpp>
#include <string>
#include <utility>
#include <vector>

#include "client/link/connection.h"
#include "client/link/sender.h"
#include "client/link/state_view.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/vocabulary.h"

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
  bool all_prefixes = false;  ///< what only looks (status, watch) looks at every daemon that is heard
};

/// The daemon's answer to one order.
struct Answer {
  bool accepted = false;
  Reason reason = Reason::kAccepted;
  std::string text;  ///< the daemon's words, safe to print
};

class Client {
 public:
  /// How often an order is repeated while no answer comes: LCM may lose messages. The daemon answers a
  /// repetition as it answered the first.
  static constexpr int kRepetitions = 3;

  Client(Connection& connection, const ClientOptions& options);

  const ClientOptions& options() const noexcept { return options_; }
  Connection& connection() noexcept { return connection_; }
  const StateView& states() const noexcept { return states_; }

  /// The latest view of `joint`, or null when nothing was heard of it.
  const JointView* find(const std::string& joint) const { return states_.find(options_.prefix, joint); }

  /// Waits until `joint` is heard. Throws ClientError (no answer) that says what is heard instead.
  const JointView& wait_for_joint(const std::string& joint);

  /// Waits until a joint is heard, then a little for the others of the daemon. Throws like wait_for_joint().
  std::vector<std::string> wait_for_joints();

  /// Joints that are heard of the prefix, or of all with all_prefixes; in order.
  std::vector<JointName> heard() const;
  /// The same after waiting as wait_for_joints() does.
  std::vector<JointName> wait_for_heard();

  /// Sends `message` (setpoint_v1, command_v1 or gain_table_v1) to `joint` on the channel of `kind` and waits
  /// for the answer. Throws ClientError when the joint is not heard or no answer comes.
  template <typename Message>
  Answer request(const std::string& joint, std::string_view kind, const Message& message) {
    const std::int64_t session_id = wait_for_joint(joint).state.session_id;
    return exchange(joint, sender_.seal(channel(options_.prefix, joint, kind), message, session_id));
  }

  /// The same for an order that must go out even when nothing is heard of the joint: a stop. It does not wait
  /// for a state, and is not signed; without a state the session is 0, which the daemon ignores in a disable.
  template <typename Message>
  Answer request_unseen(const std::string& joint, std::string_view kind, const Message& message) {
    const JointView* view = find(joint);
    const std::int64_t session_id = view != nullptr ? view->state.session_id : 0;
    return exchange(joint, sender_.seal_unsigned(channel(options_.prefix, joint, kind), message, session_id));
  }

  /// Sends `message` to a joint that is heard, once and without waiting: one of a stream. Only a refusal of
  /// it is answered, see take_refusal().
  template <typename Message>
  void send(const std::string& joint, std::string_view kind, const Message& message) {
    const std::int64_t session_id = wait_for_joint(joint).state.session_id;
    const SealedMessage sealed = sender_.seal(channel(options_.prefix, joint, kind), message, session_id);
    connection_.publish(sealed.channel, sealed.bytes);
  }

  /// The daemon's latest refusal of a message of send() since the last call.
  std::optional<Answer> take_refusal() { return std::exchange(refusal_, std::nullopt); }

  /// Dispatches messages until `done()` or the deadline; the last value of done(). Throws ClientError
  /// (interrupted).
  template <typename Done>
  bool wait_until(const Done& done, const Deadline& deadline) {
    while (!done()) {
      if (deadline.passed()) return false;
      handle(deadline.remaining_ms());
    }
    return true;
  }

 private:
  Answer exchange(const std::string& joint, const SealedMessage& order);
  void handle(int timeout_ms);
  void on_ack(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  [[noreturn]] void explain_silence(const std::string& joint) const;

  Connection& connection_;
  ClientOptions options_;
  StateView states_;
  Sender sender_;
  const SealedMessage* awaited_ = nullptr;  ///< the order whose answer counts
  std::string awaited_channel_;             ///< where its answer comes from
  std::optional<ack_v1> ack_;
  std::int64_t requested_ = 0;  ///< sequence of the last order that was waited for
  std::optional<Answer> refusal_;
  Subscription acknowledgements_;
};

}  // namespace strainwave
