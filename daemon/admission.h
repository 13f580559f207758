// Every message from outside passes here before the loop may hear of it: exact size, channel, session, sequence, finite,
// range, table certificate. Pure: bytes in, verdict out; no threads, sockets or clocks. Not real-time.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/gain_table.h"
#include "daemon/realtime/orders.h"
#include "daemon/shared_memory.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

/// What admission must know of a joint.
struct JointAdmission {
  std::string name;
  PlantIdentity plant;
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double torque_limit_Nm = 0.0;
  bool takes_injected_faults = false;  ///< the simulated driver's
};

/// Whom an answer is for.
struct Requester {
  std::size_t joint = 0;
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  bool wants_acknowledgement = true;
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
  Order order;                        ///< kOrder
  std::unique_ptr<GainTable> table;   ///< kOrder of a table
  bool revert_table = false;          ///< kOrder: use the previous table again
};

class Admission {
 public:
  Admission(std::string prefix, std::int64_t session_id, std::vector<JointAdmission> joints);

  /// Judges one message and counts a refusal under its cause.
  Verdict consider(const WireMessage& message);

  /// A refusal decided elsewhere (by the loop) belongs to the same counts.
  void count_reject(Reason reason) noexcept { ++rejects_[static_cast<std::size_t>(reason)]; }
  const std::array<std::int64_t, kReasonCount>& rejects() const noexcept { return rejects_; }

 private:
  struct Envelope {
    std::int64_t session_id;
    std::int64_t sender_id;
    std::int64_t sequence;
  };
  Verdict judge(std::string_view kind, std::size_t joint, const WireMessage& message);
  Verdict judge_setpoint(std::size_t joint, const WireMessage& message);
  Verdict judge_command(std::size_t joint, const WireMessage& message);
  Verdict judge_table_message(std::size_t joint, const WireMessage& message);
  Verdict judge_injection(std::size_t joint, const WireMessage& message);
  /// A refusal or a repeat, or nothing when the envelope is in order.
  std::optional<Verdict> check_envelope(const Envelope& envelope, const Requester& requester);
  bool remember(std::int64_t sender_id, std::int64_t sequence);

  std::string prefix_;
  std::int64_t session_id_;
  std::vector<JointAdmission> joints_;
  std::map<std::int64_t, std::int64_t> last_sequence_;  ///< by sender, bounded
  std::array<std::int64_t, kReasonCount> rejects_{};
};

}  // namespace strainwave
