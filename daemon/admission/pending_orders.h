// SPDX-License-Identifier: BSD-3-Clause
// Orders that were admitted, until they are answered. It hands them to the joints' loops, stores tables where the loop does not look,
// waits for the replies, and names the clients to answer. Not real-time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "daemon/admission/admission.h"
#include "daemon/admission/answers.h"
#include "daemon/admission/fair_share.h"
#include "daemon/admission/table_book.h"
#include "daemon/admission/table_prover.h"
#include "daemon/realtime/loop/realtime_loop.h"

namespace strainwave {

class PendingOrders {
 public:
  /// Answers a second to messages that anybody could have sent: enough for people, too few to crowd out the others. Sources
  /// share them.
  static constexpr double kStrangerAnswersPer_s = 200.0;
  static constexpr double kStrangerAnswersAtOnce = 50.0;
  /// The same for stops: no forgery of another order uses this share up.
  static constexpr double kStopAnswersPer_s = 1000.0;
  static constexpr double kStopAnswersAtOnce = 200.0;
  static constexpr std::int64_t kReplyTimeout_ns = 500'000'000;
  /// Of the places in which orders of a joint wait for its loop: a disable and a hold always find one.
  static constexpr std::size_t kPlacesForStops = 2;
  /// Senders of equal stops that get the one reply to them, beyond the first; half of the places are for those who sign.
  static constexpr std::size_t kCompanions = 1024;

  PendingOrders(RealtimeLoop& loop, Admission& admission, Answers& answers);

  /// Begins to prove tables, for which there is a thread.
  void start() { prover_.start(); }

  /// Whether the loop owes a reply.
  bool waiting() const noexcept { return !pending_.empty(); }

  /// Before the loop runs: its first order. False when the joint cannot take it.
  bool load_first_table(std::size_t joint, const GainTable& table);

  /// Obeys the verdict as far as the loop need not; afterwards `verdict` says what has become of it.
  void handle(Verdict& verdict, std::int64_t now_ns);

  /// Passes on tables that were proved meanwhile; answers what the loop has replied to, and what it has not replied to in time.
  void take_replies(std::int64_t now_ns);

  /// A state that the loop has published since. A table whose reply was lost is in use by then, or never will be.
  void observe(const StateRecord& record);

 private:
  struct Pending {
    Requester requester;
    std::string text;  ///< to send with the acceptance
    std::int64_t deadline_ns;
    std::int64_t table_id;  ///< of a table order, else 0
    OrderKind kind;
    std::vector<Requester> companions = {};  ///< of equal stops that came before its reply
  };
  /// Stops that nothing but stops came after: another one would do no more. 0: none.
  struct LatestStops {
    std::int64_t disable_id = 0;
    std::int64_t hold_id = 0;
  };
  /// A table order whose reply did not come.
  struct Unanswered {
    std::int64_t order_id = 0;  ///< 0: none
    std::int64_t table_id = 0;
    std::int64_t cycle = 0;  ///< when the waiting ended
  };
  void obey(Verdict& verdict, std::int64_t now_ns);
  void give(Verdict& verdict, std::int64_t now_ns);
  bool push(const Verdict& verdict);
  bool joins_equal_stop(const Verdict& verdict);
  std::int64_t& latest_stop(const Verdict& verdict);
  void take_proved_table(std::int64_t now_ns);
  bool prepare_table(Verdict& verdict, std::int64_t& table_id);
  bool prepare_path(Verdict& verdict);
  void undo_preparation(const Verdict& verdict);
  void refuse(Verdict& verdict, Reason reason, const std::string& text, std::int64_t now_ns);
  void answer(const Requester& to, Reason reason, const std::string& text, std::int64_t now_ns);
  void answer_all(const Pending& pending, Reason reason, const std::string& text, std::int64_t now_ns);
  void give_up(std::int64_t order_id, const Pending& pending, std::int64_t now_ns);

  RealtimeLoop& loop_;
  Admission& admission_;
  Answers& answers_;
  std::vector<TableBook> books_;
  std::vector<LatestStops> latest_stops_;    ///< by joint
  std::vector<Unanswered> unanswered_;       ///< by joint: its book is busy until this is known
  std::map<std::int64_t, Pending> pending_;  ///< orders without a reply yet, by order id
  TableProver prover_;
  std::int64_t next_order_id_ = 1;
  FairShare stranger_answers_{kStrangerAnswersPer_s, kStrangerAnswersAtOnce};
  FairShare stop_answers_{kStopAnswersPer_s, kStopAnswersAtOnce};
};

}  // namespace strainwave
