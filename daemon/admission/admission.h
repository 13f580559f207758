// SPDX-License-Identifier: BSD-3-Clause
// Every message from outside passes here before the loop may hear of it: exact size, channel, session, challenge,
// signature and role, sequence, owner, finite, range, table certificate. Pure: bytes in, verdict out; no threads,
// sockets or clocks. Not real-time.
//
// What a sender without a key can change here: the counts of rejects and the budget of wasted verifications,
// nothing else. Sequences are remembered per key and joint, and only of messages whose signature is right.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/table/gain_table.h"
#include "daemon/admission/authorized_keys.h"
#include "daemon/admission/challenges.h"
#include "daemon/admission/fair_share.h"
#include "daemon/admission/ownership.h"
#include "daemon/admission/sequence_memory.h"
#include "daemon/admission/table_admission.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/joint/orders.h"
#include "daemon/realtime/path/path_slots.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

/// What admission must know of a joint.
struct JointAdmission {
  std::string name;
  ExpectedJoint expected;  ///< by its tables
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_limit_rad_s = 0.0;
  bool takes_injected_faults = false;  ///< the simulated driver's
  PathLimits path = {};                ///< what its paths may need
};

/// Whom an answer is for.
struct Requester {
  std::size_t joint = 0;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  bool wants_acknowledgement = true;
  /// From a sender that may give orders, and new: its answer is worth remembering for a resend. Others could
  /// make the daemon forget answers or flood the bus with new ones.
  bool authentic = false;
  bool stop = false;  ///< of a disable or hold, whose answers have a share of their own
  bool owns = false;  ///< the order needed the joint: Admission::settle() wants to know what became of it
  bool takes_over =
      false;  ///< of a take-over: the joint is his once its order is with the loop, Admission::take_over()
  std::int64_t key = -1;           ///< index of the key that signed, -1: none
  std::int64_t last_sequence = 0;  ///< with kOldSequence: what the sequence must rise above
  std::uint64_t source = 0;        ///< as WireMessage::source
};

/// What to do with one message.
struct Verdict {
  enum class Kind {
    kOrder,  ///< pass `order` to the joint's loop and answer with its reply; a table's box is still to be proved
    kRefuse,   ///< answer with reason and text
    kRepeat,   ///< a resend of the last message of this sender: give the same answer again
    kDone,     ///< obeyed here: answer that it is accepted
    kDiscard,  ///< no sender to answer; only counted
  };
  Kind kind = Kind::kDiscard;
  Reason reason = Reason::kAccepted;
  std::string text;
  Requester requester;
  Order order;                       ///< kOrder
  std::int64_t stop_count = 0;       ///< kOrder: Admission::stop_count() then
  std::unique_ptr<GainTable> table;  ///< kOrder of a table
  bool proves_box = true;            ///< that table's box is to be proved before it is used
  bool revert_table = false;         ///< kOrder: use the previous table again
  std::unique_ptr<LoadedPath> path;  ///< kOrder of a path
};

class Admission {
 public:
  /// Verifications a second that may end in a refusal, on the average and at once. One costs about 0.1 ms:
  /// forgeries get at most an eighth of one processor, and beyond it they are refused unread. Sources share it.
  static constexpr double kWastedVerificationsPer_s = 1000.0;
  static constexpr double kWastedVerificationsAtOnce = 200.0;
  /// Identities without a key that are remembered.
  static constexpr std::size_t kUnsignedSenders = 256;

  Admission(std::string prefix, std::int64_t session_id, std::vector<JointAdmission> joints,
            SecurityPolicy security);

  /// It is `cycle` now; `random` becomes the next challenge when one is due. Returns the challenge to publish.
  std::int64_t advance(std::int64_t cycle, std::int64_t random) { return challenges_.advance(cycle, random); }

  /// From now on nothing but stops: the daemon is ending.
  void end_orders() noexcept { ending_ = true; }

  /// Judges one message that is looked at at `now_ns` (monotonic) and counts a refusal under its cause.
  Verdict consider(const WireMessage& message, std::int64_t now_ns);

  /// What became of an order that was passed on.
  void settle(const Requester& requester, bool accepted, std::int64_t now_ns) {
    if (requester.owns)
      ownership_.settle(requester.joint, {requester.key, requester.sender_id}, accepted, now_ns);
  }
  /// The order that ends his predecessor's stream is on its way: whatever the joint obeys after it is his.
  void take_over(const Requester& requester, std::int64_t now_ns) {
    ownership_.take(requester.joint, {requester.key, requester.sender_id}, now_ns);
  }
  const Ownership& ownership() const noexcept { return ownership_; }

  /// `joint` has faulted in `cycle`: as after a stop, no order from before is obeyed.
  void fault(std::size_t joint, std::int64_t cycle) noexcept { challenges_.fault(joint, cycle); }
  std::int64_t stop_count(std::size_t joint) const noexcept { return challenges_.stop_count(joint); }
  /// For how many cycles an order that was fresh when it came may wait.
  std::int64_t order_lifetime_cycles() const noexcept { return challenges_.lifetime_cycles(); }

  /// A refusal decided elsewhere (by the loop) belongs to the same counts.
  void count_reject(Reason reason) noexcept { ++rejects_[static_cast<std::size_t>(reason)]; }
  const std::array<std::int64_t, kReasonCount>& rejects() const noexcept { return rejects_; }

 private:
  struct Envelope {
    std::int64_t session_id;
    std::int64_t challenge;
    Role needed;
    bool needs_joint;  ///< only the joint's owner may order it
  };
  Verdict judge(std::string_view kind, std::size_t joint, const WireMessage& message);
  bool repeats(const WireMessage& message, const Requester& requester) const;
  Verdict judge_setpoint(std::size_t joint, const WireMessage& message);
  Verdict judge_command(std::size_t joint, const WireMessage& message);
  Verdict judge_table_message(std::size_t joint, const WireMessage& message);
  Verdict judge_injection(std::size_t joint, const WireMessage& message);
  Verdict judge_path(std::size_t joint, const WireMessage& message);
  /// Who does not have all joints of the path that the requester's is to have part of, or nothing.
  std::optional<Verdict> check_path_owner(const Requester& requester);
  /// A refusal or a repeat, or nothing when the envelope is in order; then the requester is authentic.
  std::optional<Verdict> check_envelope(const WireMessage& message, const Envelope& envelope,
                                        Requester& requester);
  std::optional<Verdict> check_signed(const WireMessage& message, std::size_t key, Role needed,
                                      Requester& requester);
  std::optional<Verdict> check_sequence(SequenceMemory& memory, std::int64_t who, Requester& requester) const;
  /// The key that it says it is signed with, -1: none of ours.
  std::int64_t claimed_key(const WireMessage& message) const;
  std::optional<Verdict> check_fresh(const WireMessage& message, std::int64_t challenge,
                                     const Requester& requester) const;
  std::optional<Verdict> check_owner(Requester& requester);
  std::optional<Verdict> check_sender(const WireMessage& message, Role needed, Requester& requester,
                                      FairShare& verifications);
  Verdict stop(const WireMessage& message, OrderKind kind, std::int64_t session_id, std::int64_t challenge,
               Requester requester);
  Verdict change_owner(Action action, Requester requester);
  Verdict pass(const Requester& requester, OrderKind kind, std::int64_t challenge) const;

  std::string prefix_;
  std::int64_t session_id_;
  std::vector<JointAdmission> joints_;
  SecurityPolicy security_;
  Challenges challenges_;
  Ownership ownership_;
  SequenceMemory sequences_;
  SequenceMemory unsigned_sequences_;
  std::vector<std::int64_t> path_ids_;  ///< of the last path that was passed on, by joint
  FairShare verifications_{kWastedVerificationsPer_s, kWastedVerificationsAtOnce};
  FairShare stop_verifications_{kWastedVerificationsPer_s, kWastedVerificationsAtOnce};
  bool ending_ = false;
  std::int64_t now_ns_ = 0;
  std::array<std::int64_t, kReasonCount> rejects_{};
};

}  // namespace strainwave
