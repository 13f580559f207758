// SPDX-License-Identifier: BSD-3-Clause
// Keeps admitted orders until they are answered. Hands them to the joints' loops, stores tables in slots that the loop does not use,
// waits for the replies, and answers the clients. Not real-time.
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
  /// Average rate and burst of answers to unverified senders, shared by all sources: enough for people, too few to crowd out
  /// other answers.
  static constexpr double kStrangerAnswersPer_s = 200.0;
  static constexpr double kStrangerAnswersAtOnce = 50.0;
  /// The same for stops, as a separate budget that forged orders cannot use up.
  static constexpr double kStopAnswersPer_s = 1000.0;
  static constexpr double kStopAnswersAtOnce = 200.0;
  static constexpr std::int64_t kReplyTimeout_ns = 500'000'000;
  /// Places of a joint's order queue that are kept for stops, so that a disable and a hold always find one.
  static constexpr std::size_t kPlacesForStops = 2;
  /// Further senders of equal stops that share the reply to the first. Half of the places are kept for verified senders.
  static constexpr std::size_t kCompanions = 1024;

  PendingOrders(RealtimeLoop& loop, Admission& admission, Answers& answers);

  /// Starts the thread that proves tables.
  void start() { prover_.start(); }

  /// Whether the loop owes a reply.
  bool waiting() const noexcept { return !pending_.empty(); }

  /// Call it before the loop runs: makes `table` the joint's first order. False when the joint cannot take it.
  bool load_first_table(std::size_t joint, const GainTable& table);

  /// Acts on the verdict: answers it, or passes the order on. A refusal by this class is entered in `verdict`.
  void handle(Verdict& verdict, std::int64_t now_ns);

  /// Passes on a proved table. Answers orders to which the loop has replied, and those whose reply is overdue. Returns the order of a
  /// table that is refused now.
  std::optional<Verdict> take_replies(std::int64_t now_ns);

  /// Evaluates a state from the loop: it shows whether a table is in use whose reply was lost.
  void observe(const StateRecord& record);

 private:
  struct Pending {
    Requester requester;
    std::string text;  ///< to send with the acceptance
    std::int64_t deadline_ns;
    std::int64_t table_id;  ///< of a table order, else 0
    OrderKind kind;
    std::vector<Requester> companions = {};  ///< senders of equal stops before its reply
  };
  /// Ids of the latest stops that only stops have followed, so that an equal stop would change nothing. 0: none.
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
  std::optional<Verdict> take_proved_table(std::int64_t now_ns);
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
  std::vector<Unanswered> unanswered_;       ///< by joint; its book stays busy until this is settled
  std::map<std::int64_t, Pending> pending_;  ///< orders without a reply yet, by order id
  TableProver prover_;
  std::int64_t next_order_id_ = 1;
  FairShare stranger_answers_{kStrangerAnswersPer_s, kStrangerAnswersAtOnce};
  FairShare stop_answers_{kStopAnswersPer_s, kStopAnswersAtOnce};
};

}  // namespace strainwave
