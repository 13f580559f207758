// Every message from outside passes here before the loop may hear of it: exact size, channel, session,
// signature and role, sequence, finite, range, table certificate. Pure: bytes in, verdict out; no threads,
// sockets or clocks. Not real-time.
//
// What somebody without a key can change here: the counts of rejects and the budget of wasted verifications,
// nothing else. Sequences are remembered per key, and only of messages whose signature is right.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/gain_table.h"
#include "daemon/admission/authorized_keys.h"
#include "daemon/admission/sequence_memory.h"
#include "daemon/admission/token_bucket.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/orders.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

/// What admission must know of a joint.
struct JointAdmission {
  std::string name;
  PlantIdentity plant;
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double torque_limit_Nm = 0.0;
  double speed_limit_rad_s = 0.0;
  bool takes_injected_faults = false;  ///< the simulated driver's
};

/// Whom an answer is for.
struct Requester {
  std::size_t joint = 0;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  bool wants_acknowledgement = true;
  /// From somebody who may give orders, and new: its answer is worth remembering for a resend. Others could
  /// make the daemon forget answers or flood the bus with new ones.
  bool authentic = false;
};

/// What to do with one message.
struct Verdict {
  enum class Kind {
    kOrder,    ///< pass `order` to the joint's loop and answer with its reply
    kRefuse,   ///< answer with reason and text
    kRepeat,   ///< a resend of the last message of this sender: give the same answer again
    kDiscard,  ///< nobody to answer; only counted
  };
  Kind kind = Kind::kDiscard;
  Reason reason = Reason::kAccepted;
  std::string text;
  Requester requester;
  Order order;                       ///< kOrder
  std::unique_ptr<GainTable> table;  ///< kOrder of a table
  bool revert_table = false;         ///< kOrder: use the previous table again
};

class Admission {
 public:
  /// Verifications a second that may end in a refusal, on the average and at once. One costs about 0.1 ms:
  /// whoever sends forgeries gets at most an eighth of one processor, and beyond it they are refused unread.
  static constexpr double kWastedVerificationsPer_s = 1000.0;
  static constexpr double kWastedVerificationsAtOnce = 200.0;

  Admission(std::string prefix, std::int64_t session_id, std::vector<JointAdmission> joints,
            SecurityPolicy security);

  /// Judges one message that is looked at at `now_ns` (monotonic) and counts a refusal under its cause.
  Verdict consider(const WireMessage& message, std::int64_t now_ns);

  /// A refusal decided elsewhere (by the loop) belongs to the same counts.
  void count_reject(Reason reason) noexcept { ++rejects_[static_cast<std::size_t>(reason)]; }
  const std::array<std::int64_t, kReasonCount>& rejects() const noexcept { return rejects_; }

 private:
  struct Envelope {
    std::int64_t session_id;
    Role needed;
  };
  Verdict judge(std::string_view kind, std::size_t joint, const WireMessage& message);
  Verdict judge_setpoint(std::size_t joint, const WireMessage& message);
  Verdict judge_command(std::size_t joint, const WireMessage& message);
  Verdict judge_table_message(std::size_t joint, const WireMessage& message);
  Verdict judge_injection(std::size_t joint, const WireMessage& message);
  /// A refusal or a repeat, or nothing when the envelope is in order; then the requester is authentic.
  std::optional<Verdict> check_envelope(const WireMessage& message, const Envelope& envelope,
                                        Requester& requester);
  std::optional<Verdict> check_signed(const WireMessage& message, std::size_t key, Role needed,
                                      Requester& requester);
  static std::optional<Verdict> check_sequence(SequenceMemory& memory, Requester& requester);

  std::string prefix_;
  std::int64_t session_id_;
  std::vector<JointAdmission> joints_;
  SecurityPolicy security_;
  std::vector<SequenceMemory> sequences_;  ///< of each key
  SequenceMemory unsigned_sequences_{false};
  TokenBucket verifications_{kWastedVerificationsPer_s, kWastedVerificationsAtOnce};
  std::int64_t now_ns_ = 0;
  std::array<std::int64_t, kReasonCount> rejects_{};
};

}  // namespace strainwave
