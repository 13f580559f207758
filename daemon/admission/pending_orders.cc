// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/pending_orders.h"

#include <optional>
#include <string>
#include <utility>

#include "daemon/admission/refusal_advice.h"
#include "daemon/admission/table_admission.h"

namespace strainwave {

PendingOrders::PendingOrders(RealtimeLoop& loop, Admission& admission, Answers& answers)
    : loop_(loop),
      admission_(admission),
      answers_(answers),
      books_(loop.joint_count()),
      latest_stops_(loop.joint_count()),
      unanswered_(loop.joint_count()) {}

bool PendingOrders::load_first_table(std::size_t joint, const GainTable& table) {
  Verdict verdict;
  verdict.table = std::make_unique<GainTable>(table);
  verdict.requester.joint = joint;
  verdict.order.kind = OrderKind::kUseTable;
  std::int64_t table_id = 0;
  if (!prepare_table(verdict, table_id) || !loop_.joint(joint).orders().push(verdict.order)) return false;
  books_[joint].end(true);
  return true;
}

void PendingOrders::handle(Verdict& verdict, std::int64_t now_ns) {
  switch (verdict.kind) {
    case Verdict::Kind::kDiscard:
      return;
    case Verdict::Kind::kRepeat:
      if (stranger_answers_.try_take(verdict.requester.source, now_ns)) answers_.repeat(verdict.requester);
      return;
    case Verdict::Kind::kRefuse:
      return answer(verdict.requester, verdict.reason, verdict.text, now_ns);
    case Verdict::Kind::kDone:
      return answer(verdict.requester, Reason::kAccepted, verdict.text, now_ns);
    case Verdict::Kind::kOrder:
      return obey(verdict, now_ns);
  }
}

void PendingOrders::obey(Verdict& verdict, std::int64_t now_ns) {
  if (verdict.table == nullptr || !verdict.proves_box) return give(verdict, now_ns);
  if (!prover_.hand_over(verdict))
    refuse(verdict, Reason::kBusy, "another table is still being proved", now_ns);
}

std::optional<Verdict> PendingOrders::take_proved_table(std::int64_t now_ns) {
  std::optional<TableProver::Proved> proved = prover_.take();
  if (!proved) return {};
  Verdict& verdict = proved->order;
  if (proved->box.reason != Reason::kAccepted) {
    refuse(verdict, proved->box.reason, proved->box.text, now_ns);
  } else if (verdict.stop_count != admission_.stop_count(verdict.requester.joint)) {
    refuse(verdict, Reason::kSuperseded,
           "the joint was stopped or faulted while the table was proved: send it again", now_ns);
  } else {
    verdict.text += proved->box.text;
    verdict.order.expires_cycle = loop_.statistics().cycle.load() +
                                  admission_.order_lifetime_cycles();  // the order was fresh when it arrived
    give(verdict, now_ns);
  }
  if (verdict.kind != Verdict::Kind::kRefuse) return {};
  return std::move(verdict);
}

void PendingOrders::give(Verdict& verdict, std::int64_t now_ns) {
  if (verdict.requester.stop && joins_equal_stop(verdict)) return;
  std::int64_t table_id = 0;
  const bool is_table = verdict.order.kind == OrderKind::kUseTable;
  if (is_table && !prepare_table(verdict, table_id))
    return refuse(verdict, verdict.reason, verdict.text, now_ns);
  if (verdict.order.kind == OrderKind::kLoadPath && !prepare_path(verdict))
    return refuse(verdict, Reason::kBusy, "another path is still being taken over", now_ns);
  verdict.order.id = next_order_id_++;
  if (!push(verdict)) {
    undo_preparation(verdict);
    return refuse(verdict, Reason::kBusy,
                  "too many orders at once: at most " + std::to_string(kMostWaitingOrders - kPlacesForStops) +
                      " orders of a joint may wait for the loop. Send fewer, or wait for the answers",
                  now_ns);
  }
  if (verdict.requester.takes_over) admission_.take_over(verdict.requester, now_ns);
  pending_[verdict.order.id] = {verdict.requester, verdict.text, now_ns + kReplyTimeout_ns, table_id,
                                verdict.order.kind};
}

// Other orders leave room for a disable and a hold. Further equal stops join the waiting one, see joins_equal_stop().
bool PendingOrders::push(const Verdict& verdict) {
  const std::size_t joint = verdict.requester.joint;
  JointOrderQueue& queue = loop_.joint(joint).orders();
  const bool stop = verdict.requester.stop;
  if ((!stop && queue.room() <= kPlacesForStops) || !queue.push(verdict.order)) return false;
  if (stop)
    latest_stop(verdict) = verdict.order.id;
  else if (verdict.order.kind == OrderKind::kResumePath)  // affects several joints
    latest_stops_.assign(latest_stops_.size(), {});
  else
    latest_stops_[joint] = {};
  return true;
}

std::int64_t& PendingOrders::latest_stop(const Verdict& verdict) {
  LatestStops& latest = latest_stops_[verdict.requester.joint];
  return verdict.order.kind == OrderKind::kDisable ? latest.disable_id : latest.hold_id;
}

bool PendingOrders::joins_equal_stop(const Verdict& verdict) {
  const auto equal = pending_.find(latest_stop(verdict));
  if (equal == pending_.end()) return false;
  std::vector<Requester>& companions = equal->second.companions;
  const std::size_t places = verdict.requester.authentic ? kCompanions : kCompanions / 2;
  if (companions.size() < places) companions.push_back(verdict.requester);
  return true;
}

void PendingOrders::refuse(Verdict& verdict, Reason reason, const std::string& text, std::int64_t now_ns) {
  verdict.kind = Verdict::Kind::kRefuse;
  verdict.reason = reason;
  verdict.text = text;
  admission_.count_reject(reason);
  admission_.settle(verdict.requester, false, now_ns);
  answer(verdict.requester, reason, text, now_ns);
}

void PendingOrders::answer(const Requester& to, Reason reason, const std::string& text, std::int64_t now_ns) {
  FairShare& share = to.stop ? stop_answers_ : stranger_answers_;
  if (to.authentic || share.try_take(to.source, now_ns)) answers_.answer(to, reason, text);
}

void PendingOrders::answer_all(const Pending& pending, Reason reason, const std::string& text,
                               std::int64_t now_ns) {
  const bool counts = reason != Reason::kAccepted && reason != Reason::kTimedOut;
  if (counts) admission_.count_reject(reason);
  answer(pending.requester, reason, text, now_ns);
  for (const Requester& companion : pending.companions) {
    if (counts) admission_.count_reject(reason);
    answer(companion, reason, text, now_ns);
  }
}

// Puts the table into a slot that the loop does not use, or names the slot to return to.
bool PendingOrders::prepare_table(Verdict& verdict, std::int64_t& table_id) {
  TableBook& book = books_[verdict.requester.joint];
  const auto slot = verdict.revert_table ? book.previous_slot() : book.free_slot();
  if (book.busy() || !slot) {
    verdict.reason = book.busy() ? Reason::kBusy : Reason::kNoPreviousTable;
    verdict.text = book.busy() ? "another table is still being taken over" : "the joint had no other table";
    return false;
  }
  JointLoop& joint = loop_.joint(verdict.requester.joint);
  if (verdict.table)
    joint.table_slot(*slot) = {*verdict.table, table_digest(*verdict.table),
                               friction_rules_digest(verdict.table->friction)};
  table_id = joint.table_slot(*slot).id;
  verdict.order.table_slot = static_cast<std::int32_t>(*slot);
  book.begin(*slot);
  return true;
}

bool PendingOrders::prepare_path(Verdict& verdict) {
  const auto slot = loop_.joint(verdict.requester.joint).joint().path_slots.hand_over(*verdict.path);
  verdict.order.path_slot = slot.value_or(0);
  return slot.has_value();
}

void PendingOrders::undo_preparation(const Verdict& verdict) {
  const std::size_t joint = verdict.requester.joint;
  if (verdict.order.kind == OrderKind::kUseTable) books_[joint].end(false);
  if (verdict.order.kind == OrderKind::kLoadPath) loop_.joint(joint).joint().path_slots.take_back();
}

std::optional<Verdict> PendingOrders::take_replies(std::int64_t now_ns) {
  std::optional<Verdict> refused = take_proved_table(now_ns);
  Reply reply;
  while (loop_.replies().pop(reply)) {
    const bool accepted = reply.reason == Reason::kAccepted;
    for (std::size_t joint = 0; joint < unanswered_.size(); ++joint)
      if (unanswered_[joint].order_id == reply.id && reply.id != 0) {
        books_[joint].end(accepted);
        unanswered_[joint] = {};
      }
    const auto found = pending_.find(reply.id);
    if (found == pending_.end()) continue;
    const Pending& pending = found->second;
    if (pending.table_id != 0) books_[pending.requester.joint].end(accepted);
    admission_.settle(pending.requester, accepted, now_ns);
    answer_all(pending, reply.reason, accepted ? pending.text : refusal_advice(reply, pending.kind), now_ns);
    pending_.erase(found);
  }
  std::erase_if(pending_, [&](const auto& entry) {
    const bool over = entry.second.deadline_ns < now_ns;
    if (over) give_up(entry.first, entry.second, now_ns);
    return over;
  });
  return refused;
}

void PendingOrders::give_up(std::int64_t order_id, const Pending& pending, std::int64_t now_ns) {
  answer_all(pending, Reason::kTimedOut, "the loop did not answer in 0.5 s: see the joint's state", now_ns);
  if (pending.table_id != 0)
    unanswered_[pending.requester.joint] = {order_id, pending.table_id, loop_.statistics().cycle.load()};
}

// The loop takes an order in the cycle after it was given. A later state shows whether the table is in use, and so whether its
// slot is free again.
void PendingOrders::observe(const StateRecord& record) {
  const auto joint = static_cast<std::size_t>(record.joint_index);
  Unanswered& unanswered = unanswered_[joint];
  if (unanswered.order_id == 0 || record.state.cycle <= unanswered.cycle + 2) return;
  books_[joint].end(record.state.table_id == unanswered.table_id);
  unanswered = {};
}

}  // namespace strainwave
