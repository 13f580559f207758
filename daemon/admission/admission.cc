// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/admission.h"

#include <algorithm>
#include <sstream>

#include "daemon/admission/verdict.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"

namespace strainwave {

Admission::Admission(std::string prefix, std::int64_t session_id, std::vector<JointAdmission> joints,
                     SecurityPolicy security)
    : prefix_(std::move(prefix)),
      session_id_(session_id),
      joints_(std::move(joints)),
      security_(std::move(security)),
      challenges_(security_.order_lifetime_cycles, joints_.size()),
      ownership_(joints_.size(), security_.lease_s),
      sequences_(challenges_.lifetime_cycles(), security_.keys.size() * joints_.size()),
      unsigned_sequences_(challenges_.lifetime_cycles(), kUnsignedSenders),
      path_ids_(joints_.size()) {}

Verdict Admission::consider(const WireMessage& message, std::int64_t now_ns) {
  now_ns_ = now_ns;
  const auto name = parse_channel(message.channel.view());
  Verdict verdict = discard(Reason::kMalformed);
  if (name && name->prefix == prefix_ && message.size <= message.bytes.size()) {
    const auto joint = std::find_if(joints_.begin(), joints_.end(), [&](const JointAdmission& candidate) {
      return candidate.name == name->joint;
    });
    verdict = joint == joints_.end()
                  ? discard(Reason::kUnknownJoint)
                  : judge(name->kind, static_cast<std::size_t>(joint - joints_.begin()), message);
  }
  verdict.requester.source = message.source;
  if (verdict.kind != Verdict::Kind::kOrder && verdict.kind != Verdict::Kind::kDone)
    count_reject(verdict.reason);
  if (verdict.kind == Verdict::Kind::kRefuse) settle(verdict.requester, false, now_ns);
  return verdict;
}

Verdict Admission::judge(std::string_view kind, std::size_t joint, const WireMessage& message) {
  if (kind == channel_kind::kSetpoint) return judge_setpoint(joint, message);
  if (kind == channel_kind::kCommand) return judge_command(joint, message);
  if (kind == channel_kind::kTable) return judge_table_message(joint, message);
  if (kind == channel_kind::kInject) return judge_injection(joint, message);
  if (kind == channel_kind::kPath) return judge_path(joint, message);
  return discard(Reason::kMalformed);
}

Verdict Admission::pass(const Requester& requester, OrderKind kind, std::int64_t challenge) const {
  Verdict verdict;
  verdict.kind = Verdict::Kind::kOrder;
  verdict.requester = requester;
  verdict.order.kind = kind;
  verdict.order.challenge_cycle = challenges_.drawn_cycle(challenge);
  verdict.order.expires_cycle = challenges_.expiry_cycle(challenge);
  verdict.stop_count = challenges_.stop_count(requester.joint);
  return verdict;
}

// Does not verify the message: a repeated answer reveals nothing new.
bool Admission::repeats(const WireMessage& message, const Requester& requester) const {
  if (is_unsigned(payload(message)))
    return unsigned_sequences_.is_last({requester.sender_id, requester.joint}, requester.sender_id,
                                       requester.sequence);
  const auto key = security_.keys.find(key_id_of(payload(message)));
  return key && sequences_.is_last({static_cast<std::int64_t>(*key), requester.joint}, requester.sender_id,
                                   requester.sequence);
}

std::optional<Verdict> Admission::check_envelope(const WireMessage& message, const Envelope& envelope,
                                                 Requester& requester) {
  if (ending_) return refuse(requester, Reason::kEnding, "the daemon is ending: it obeys only stops");
  if (envelope.session_id != session_id_)
    return refuse(requester, Reason::kWrongSession,
                  "the message names session " + std::to_string(envelope.session_id) +
                      ", but this daemon has session " + std::to_string(session_id_) +
                      " (session_id on the STATE channel): strainwaved has restarted. See what the "
                      "joint does, then send the command again");
  if (auto verdict = check_fresh(message, envelope.challenge, requester)) return verdict;
  if (auto verdict = check_sender(message, envelope.needed, requester, verifications_)) return verdict;
  return envelope.needs_joint ? check_owner(requester) : std::nullopt;
}

std::optional<Verdict> Admission::check_fresh(const WireMessage& message, std::int64_t challenge,
                                              const Requester& requester) const {
  if (challenges_.expiry_cycle(challenge) < 0) {
    // Some orders take longer than an order's lifetime, such as the proof of a table; clients repeat them meanwhile.
    if (repeats(message, requester)) return repeat(requester);
    return refuse(requester, Reason::kTooOld,
                  "the command quotes a challenge that left the STATE channel more than about a second ago: "
                  "the network delayed the command, or its sender used an old state; send it again");
  }
  const Sent order{requester.sender_id, requester.sequence, claimed_key(message)};
  switch (challenges_.since(challenge, requester.joint, order)) {
    case Since::kNothing:
      return std::nullopt;
    case Since::kOwnStop:
      return refuse(
          requester, Reason::kTooOld,
          "the command quotes a challenge from before a fault, or from before a stop by the same sender: "
          "send it again with the challenge of the next state");
    case Since::kOthersStop:
      break;
  }
  return refuse(
      requester, Reason::kSuperseded,
      "the joint was stopped or held after this command was made: see why, then send the command again");
}

// The claim is not verified: it only selects the reason of a refusal.
std::int64_t Admission::claimed_key(const WireMessage& message) const {
  if (is_unsigned(payload(message))) return -1;
  const auto key = security_.keys.find(key_id_of(payload(message)));
  return key ? static_cast<std::int64_t>(*key) : -1;
}

std::optional<Verdict> Admission::check_sender(const WireMessage& message, Role needed, Requester& requester,
                                               FairShare& verifications) {
  if (is_unsigned(payload(message))) {
    if (!security_.unsigned_allowed)
      return refuse(
          requester, Reason::kUnsigned,
          "this daemon obeys only signed orders: give a key (strainwavectl --key FILE, the key of a Joint in "
          "Python and C++, or STRAINWAVE_KEY); strainwavectl keygen --help shows how to make one");
    return check_sequence(unsigned_sequences_, requester.sender_id, requester);
  }
  const auto key = security_.keys.find(key_id_of(payload(message)));
  if (!key)
    return refuse(
        requester, Reason::kBadSignature,
        "the key of this command is not in this daemon's security.authorized_keys: add its public line there "
        "and start the daemon again");
  if (!verifications.available(message.source, now_ns_))
    return refuse(requester, Reason::kBusy,
                  "too many forged or repeated orders: the daemon verifies at most " +
                      std::to_string(static_cast<int>(kWastedVerificationsPer_s)) +
                      " of them a second; try again");
  auto verdict = check_signed(message, *key, needed, requester);
  if (verdict) {
    verifications.take(message.source, now_ns_);
  } else {
    verifications_.prove(message.source, now_ns_);
    stop_verifications_.prove(message.source, now_ns_);
  }
  return verdict;
}

std::optional<Verdict> Admission::check_signed(const WireMessage& message, std::size_t key, Role needed,
                                               Requester& requester) {
  const AuthorizedKey& signer = security_.keys[key];
  if (!verify(message.channel.view(), signer.key, payload(message)))
    return refuse(requester, Reason::kBadSignature,
                  "the signature does not match this message, its channel and its key");
  if (signer.role < needed)
    return refuse(requester, Reason::kRoleNotAllowed,
                  "the key of " + signer.comment + " has the role " + std::string(to_text(signer.role)) +
                      ", this command needs " + std::string(to_text(needed)) + " (security.authorized_keys)");
  requester.key = static_cast<std::int64_t>(key);
  return check_sequence(sequences_, requester.key, requester);
}

std::optional<Verdict> Admission::check_sequence(SequenceMemory& memory, std::int64_t who,
                                                 Requester& requester) const {
  const SequenceMemory::Identity identity{who, requester.joint};
  const auto judgement = memory.judge(identity, requester.sender_id, requester.sequence, challenges_.cycle());
  if (judgement == SequenceMemory::Judgement::kNew) {
    requester.authentic = true;
    return std::nullopt;
  }
  requester.last_sequence = memory.last(identity);
  Verdict verdict =
      refuse(requester, Reason::kOldSequence,
             "sequence " + std::to_string(requester.sequence) + " is not above " +
                 std::to_string(requester.last_sequence) +
                 ", the last of this key (unsigned: of this sender) for this joint: send a larger one");
  if (judgement == SequenceMemory::Judgement::kRepeat) verdict.kind = Verdict::Kind::kRepeat;
  return verdict;
}

std::optional<Verdict> Admission::check_owner(Requester& requester) {
  const Ownership::Holder sender{requester.key, requester.sender_id};
  requester.owns = ownership_.reserve(requester.joint, sender, now_ns_);
  if (requester.owns) return std::nullopt;
  const Ownership::Holder& owner = ownership_.holder(requester.joint);
  std::ostringstream text;
  text << "sender " << owner.sender_id;
  if (owner.key >= 0)
    text << " (key of " << security_.keys[static_cast<std::size_t>(owner.key)].comment << ")";
  text << " owns " << joints_[requester.joint].name
       << ". Its lease ends when it releases the joint or gives no command for " << security_.lease_s
       << " s (security.lease_s). An engineer's key can take over; every client may stop or hold";
  return refuse(requester, Reason::kNotOwner, text.str());
}

// Every sender may stop a joint, whatever its session, sequence and key: without torque (disable) or under control (hold).
// A sender with a verified signature gets its answer even when many others ask for one.
Verdict Admission::stop(const WireMessage& message, OrderKind kind, std::int64_t session_id,
                        std::int64_t challenge, Requester requester) {
  requester.stop = true;
  const bool meant_for_us = session_id == session_id_ && challenges_.expiry_cycle(challenge) >= 0;
  if (meant_for_us && !is_unsigned(payload(message)))
    (void)check_sender(message, Role::kOperator, requester, stop_verifications_);
  challenges_.stop(requester.joint, {requester.sender_id, requester.sequence, requester.key});
  return pass(requester, kind, 0);
}

Verdict Admission::change_owner(Action action, Requester requester) {
  requester.takes_over = action == Action::kTakeOver;
  if (requester.takes_over) return pass(requester, OrderKind::kEndStream, 0);
  if (!ownership_.release(requester.joint, {requester.key, requester.sender_id}, now_ns_))
    return refuse(requester, Reason::kNotOwner,
                  ownership_.owner_id(requester.joint, now_ns_) == 0
                      ? "the joint has no owner: the lease has ended, or its owner has released it"
                      : "only the owner of the joint can release it");
  Verdict verdict;
  verdict.kind = Verdict::Kind::kDone;
  verdict.requester = requester;
  return verdict;
}

}  // namespace strainwave
