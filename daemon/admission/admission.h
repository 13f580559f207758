// SPDX-License-Identifier: BSD-3-Clause
// Checks every message from outside before it reaches the loop: exact size, channel, session, challenge, signature and
// role, sequence, owner, finite numbers, range, table certificate. Pure: bytes in, verdict out; no threads, sockets or
// clocks. Not real-time.
//
// Unless unsigned orders are allowed, a sender without a key can only stop joints, raise the counts of rejects and use up the
// budget of wasted verifications. Sequences are remembered per key and joint, and only from messages with a valid signature.
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

/// The properties of a joint against which admission checks orders.
struct JointAdmission {
  std::string name;
  ExpectedJoint expected;  ///< what its tables must fit
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_limit_rad_s = 0.0;
  bool takes_injected_faults = false;  ///< true for the simulated driver
  PathLimits path = {};                ///< limits of its paths
};

/// The addressee of an answer.
struct Requester {
  std::size_t joint = 0;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  bool wants_acknowledgement = true;
  /// The sender may give orders and the message is new, so its answer is remembered for a resend. Other senders
  /// could make the daemon forget answers, or flood the bus with new ones.
  bool authentic = false;
  bool stop = false;               ///< a disable or hold; their answers have a separate budget
  bool owns = false;               ///< the order needs ownership: report its outcome to Admission::settle()
  bool takes_over = false;         ///< a take-over; Admission::take_over() then makes the requester the owner
  std::int64_t key = -1;           ///< index of the key that signed, -1: none
  std::int64_t last_sequence = 0;  ///< with kOldSequence: the next sequence must be larger
  std::uint64_t source = 0;        ///< see WireMessage::source
};

/// What to do with one message.
struct Verdict {
  enum class Kind {
    kOrder,    ///< pass `order` to the joint's loop and answer with its reply; first prove a table's box
    kRefuse,   ///< answer with reason and text
    kRepeat,   ///< a resend of the last message of this sender: give the same answer again
    kDone,     ///< already carried out: answer that it is accepted
    kDiscard,  ///< no sender to answer; only counted
  };
  Kind kind = Kind::kDiscard;
  Reason reason = Reason::kAccepted;
  std::string text;
  Requester requester;
  Order order;                       ///< kOrder
  std::int64_t stop_count = 0;       ///< kOrder: Admission::stop_count() at the verdict
  std::unique_ptr<GainTable> table;  ///< kOrder of a table
  bool proves_box = true;            ///< the table's box must be proved before use
  bool revert_table = false;         ///< kOrder: use the previous table again
  std::unique_ptr<LoadedPath> path;  ///< kOrder of a path
};

class Admission {
 public:
  /// Average rate and burst of verifications that end in a refusal, shared by all sources; stops have an equal second budget.
  /// One takes about 0.1 ms, so each budget costs at most an eighth of a processor. Forgeries beyond it are refused unverified.
  static constexpr double kWastedVerificationsPer_s = 1000.0;
  static constexpr double kWastedVerificationsAtOnce = 200.0;
  /// How many identities without a key are remembered.
  static constexpr std::size_t kUnsignedSenders = 256;

  Admission(std::string prefix, std::int64_t session_id, std::vector<JointAdmission> joints,
            SecurityPolicy security);

  /// Sets the present cycle; `random` becomes the next challenge when one is due. Returns the challenge to publish.
  std::int64_t advance(std::int64_t cycle, std::int64_t random) { return challenges_.advance(cycle, random); }

  /// The daemon is ending: from now on admission refuses all orders but stops.
  void end_orders() noexcept { ending_ = true; }

  /// Judges one message at `now_ns` (monotonic) and counts a refusal under its reason.
  Verdict consider(const WireMessage& message, std::int64_t now_ns);

  /// Reports the outcome of an order that was passed on.
  void settle(const Requester& requester, bool accepted, std::int64_t now_ns) {
    if (requester.owns)
      ownership_.settle(requester.joint, {requester.key, requester.sender_id}, accepted, now_ns);
  }
  /// Makes the requester the owner. Call it once the order that ends the previous owner's stream waits for the loop.
  void take_over(const Requester& requester, std::int64_t now_ns) {
    ownership_.take(requester.joint, {requester.key, requester.sender_id}, now_ns);
  }
  const Ownership& ownership() const noexcept { return ownership_; }

  /// `joint` faulted in `cycle`: as after a stop, earlier orders are refused.
  void fault(std::size_t joint, std::int64_t cycle) noexcept { challenges_.fault(joint, cycle); }
  std::int64_t stop_count(std::size_t joint) const noexcept { return challenges_.stop_count(joint); }
  /// For how many cycles an order that was fresh on arrival may wait.
  std::int64_t order_lifetime_cycles() const noexcept { return challenges_.lifetime_cycles(); }

  /// Counts a refusal that was decided elsewhere, for example by the loop.
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
  /// A refusal if another sender owns a joint of the requester's path, otherwise nothing.
  std::optional<Verdict> check_path_owner(const Requester& requester);
  /// A refusal or a repeat. Nothing if the envelope is valid; the requester is then authentic.
  std::optional<Verdict> check_envelope(const WireMessage& message, const Envelope& envelope,
                                        Requester& requester);
  std::optional<Verdict> check_signed(const WireMessage& message, std::size_t key, Role needed,
                                      Requester& requester);
  std::optional<Verdict> check_sequence(SequenceMemory& memory, std::int64_t who, Requester& requester) const;
  /// Index of the key that the message names as its signer, unverified; -1: unsigned or unknown key.
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
  std::vector<std::int64_t> path_ids_;  ///< by joint: id of the last path that was passed on
  FairShare verifications_{kWastedVerificationsPer_s, kWastedVerificationsAtOnce};
  FairShare stop_verifications_{kWastedVerificationsPer_s, kWastedVerificationsAtOnce};
  bool ending_ = false;
  std::int64_t now_ns_ = 0;
  std::array<std::int64_t, kReasonCount> rejects_{};
};

}  // namespace strainwave
