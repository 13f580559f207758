// SPDX-License-Identifier: BSD-3-Clause
// Sends orders from the watch screen to joints of any daemon. They are repeated and answered while the screen
// continues. Not real-time.
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

  /// `states` holds the newest state of each joint, which the orders quote. An order without an answer is
  /// repeated for `timeout_s` and then reported.
  OrderDesk(Connection& connection, const StateView& states, const std::filesystem::path& key_file,
            double timeout_s);

  /// Disables each joint. The stop is signed if possible, otherwise unsigned: a wrong key or session does not hold it back. Forged
  /// messages do not stop its answer. For several joints the message counts the acceptances and names the joints that did not accept.
  void stop(const std::vector<Name>& joints);
  /// The order is signed if there is a key. Throws InputError when the key cannot be used. If another program with this key was
  /// ahead, the order is sent again with a higher sequence, a few times. An order to clear a fault is not sent if there is none.
  void order(const Name& joint, Action action);
  void move(const Name& joint, double position_rad);

  /// Repeats unanswered orders. Call it often.
  void tick() { orders_.tick(); }

  /// The latest message: "SW.elbow: enable accepted". It is empty ten seconds after the last answer, when it may be outdated.
  std::string message(Instant at = now()) const;
  bool alarm() const noexcept { return alarm_; }

  struct Refusal {
    Instant when;
    std::string text;
  };
  /// Recent refusals and unanswered orders, the latest first.
  const std::deque<Refusal>& refusals() const noexcept { return refusals_; }

 private:
  /// One request, for one or several joints.
  struct Batch {
    std::string what;
    std::string whose;  ///< the joint's name, or the number of joints
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
  Instant said_{};  ///< time of `message_`
  bool alarm_ = false;
  std::deque<Refusal> refusals_;
  Subscription acknowledgements_;
};

}  // namespace strainwave
