// SPDX-License-Identifier: BSD-3-Clause
// Orders from the watch screen, to joints of any daemon: sent, repeated and answered while the screen goes
// on. Not real-time.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "client/protocol/clock.h"
#include "client/protocol/connection.h"
#include "client/protocol/open_orders.h"
#include "client/protocol/sender.h"
#include "client/protocol/state_view.h"

namespace strainwave {

class OrderDesk {
 public:
  using Name = OpenOrders::Name;

  /// `states`: where the newest of each joint is, which its orders quote. `timeout_s`: how long an order is repeated before its
  /// silence is reported.
  OrderDesk(Connection& connection, const StateView& states, const std::filesystem::path& key_file,
            double timeout_s);

  /// A disable of each, signed if that is possible and unsigned if not: a wrong key or session does not keep it back,
  /// and forged messages do not stop its answer. Of several, the message counts the answers and names who did not give one.
  void stop(const std::vector<Name>& joints);
  /// Signed if there is a key. Throws InputError when the key cannot be used. What is refused unread, since another program of this
  /// key was ahead, is sent with a higher sequence, a few times. To clear a fault that is not there is not sent.
  void order(const Name& joint, Action action);
  void move(const Name& joint, double position_rad);

  /// Repeats what was not answered. Call often.
  void tick() { orders_.tick(); }

  /// What there is to say, the latest: "SW.elbow: enable accepted". Nothing any more ten seconds later, when it need not be true.
  std::string message(Instant at = now()) const;
  bool alarm() const noexcept { return alarm_; }

  struct Refusal {
    Instant when;
    std::string text;
  };
  /// Refusals and silences, the latest first, a few.
  const std::deque<Refusal>& refusals() const noexcept { return refusals_; }

 private:
  /// What was asked for at once, of one or several joints.
  struct Batch {
    std::string what;
    std::string whose;  ///< the joint's name, or how many
    std::size_t joints = 0;
    std::size_t accepted = 0;
    std::vector<std::string> failures;
  };
  template <typename Message>
  void post(const Name& joint, std::string_view kind, const Message& message, std::string what);
  void post(const Name& joint, OpenOrders::Seal seal, const Patience& patience, std::shared_ptr<Batch> batch);
  Quote quote(const Name& joint) const;
  void conclude(const Name& joint, Batch& batch, const Answer* answer);
  void report(const Batch& batch);
  void say(std::string message, bool alarm);
  void on_ack(const ReceivedMessage& message);

  const StateView& states_;
  Sender sender_;
  OpenOrders orders_;
  double timeout_s_;
  std::string message_;
  Instant said_{};  ///< when `message_` was
  bool alarm_ = false;
  std::deque<Refusal> refusals_;
  Subscription acknowledgements_;
};

}  // namespace strainwave
