#include "daemon/admission/admission.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/setpoint_v2.hpp>

#include "daemon/admission/table_admission.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/gain_table_message.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr double kMaxValidFor_s = 3600.0;
constexpr double kMaxInjection_s = 3600.0;
// Of a stream's samples: what no joint does. What this one cannot do is followed as far as its limits allow.
constexpr double kMaxVelocity_rad_s = 1000.0;
constexpr double kMaxAcceleration_rad_s2 = 1e6;

std::span<const std::uint8_t> payload(const WireMessage& message) {
  return {message.bytes.data(), std::min<std::size_t>(message.size, message.bytes.size())};
}

Verdict refuse(const Requester& requester, Reason reason, const std::string& text) {
  Verdict verdict;
  verdict.kind = Verdict::Kind::kRefuse;
  verdict.reason = reason;
  verdict.text = text;
  verdict.requester = requester;
  return verdict;
}

Verdict discard(Reason reason) {
  Verdict verdict;
  verdict.reason = reason;
  return verdict;
}

// What a setpoint says beyond its position must be possible, and is for streams only.
std::optional<std::string> complaint_about_motion(const setpoint_v2& setpoint) {
  std::ostringstream text;
  if (setpoint.derivatives < 0 || setpoint.derivatives > 2)
    text << "derivatives = " << setpoint.derivatives << ": 0, 1 (velocity) or 2 (acceleration, too)";
  else if (setpoint.stream_id == 0 && (setpoint.derivatives != 0 || setpoint.at_cycle != 0))
    text << "a move (stream_id 0) ends at rest, as soon as it can: derivatives and at_cycle must be 0";
  else if (setpoint.at_cycle < 0)
    text << "at_cycle = " << setpoint.at_cycle << ": a cycle to come, or 0 for none";
  else if (std::abs(setpoint.velocity_rad_s) > kMaxVelocity_rad_s)
    text << "velocity_rad_s = " << setpoint.velocity_rad_s << ": at most " << kMaxVelocity_rad_s;
  else if (std::abs(setpoint.acceleration_rad_s2) > kMaxAcceleration_rad_s2)
    text << "acceleration_rad_s2 = " << setpoint.acceleration_rad_s2 << ": at most "
         << kMaxAcceleration_rad_s2;
  else
    return std::nullopt;
  return text.str();
}

std::optional<OrderKind> order_of(Action action) {
  switch (action) {
    case Action::kEnable:
      return OrderKind::kEnable;
    case Action::kDisable:
      return OrderKind::kDisable;
    case Action::kHold:
      return OrderKind::kHold;
    case Action::kClearFault:
      return OrderKind::kClearFault;
    case Action::kRevertTable:
      return OrderKind::kUseTable;
    case Action::kHome:
      return OrderKind::kHome;
    case Action::kTakeOver:
    case Action::kRelease:
      break;  // of admission itself, not of the loop
  }
  return std::nullopt;
}

}  // namespace

Admission::Admission(std::string prefix, std::int64_t session_id, std::vector<JointAdmission> joints,
                     SecurityPolicy security)
    : prefix_(std::move(prefix)),
      session_id_(session_id),
      joints_(std::move(joints)),
      security_(std::move(security)),
      challenges_(security_.order_lifetime_cycles, joints_.size()),
      ownership_(joints_.size(), security_.lease_s),
      sequences_(challenges_.lifetime_cycles(), security_.keys.size() * joints_.size()),
      unsigned_sequences_(challenges_.lifetime_cycles(), kUnsignedSenders) {}

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
  return discard(Reason::kMalformed);
}

Verdict Admission::pass(const Requester& requester, OrderKind kind, std::int64_t challenge) const {
  Verdict verdict;
  verdict.kind = Verdict::Kind::kOrder;
  verdict.requester = requester;
  verdict.order.kind = kind;
  verdict.order.expires_cycle = challenges_.expiry_cycle(challenge);
  return verdict;
}

std::optional<Verdict> Admission::check_envelope(const WireMessage& message, const Envelope& envelope,
                                                 Requester& requester) {
  if (ending_) return refuse(requester, Reason::kEnding, "the daemon is ending: only stops are obeyed");
  if (envelope.session_id != session_id_)
    return refuse(requester, Reason::kWrongSession,
                  "the message is meant for session " + std::to_string(envelope.session_id) +
                      ", this daemon's is another: read session_id from the STATE channel and send again");
  if (challenges_.expiry_cycle(envelope.challenge) < 0)
    return refuse(
        requester, Reason::kTooOld,
        "the order quotes a challenge that the STATE channel has not carried for about a second: it was "
        "kept back on its way, or made from an old state; it is not obeyed any more, give it anew");
  if (challenges_.stopped_since(envelope.challenge, requester.joint))
    return refuse(requester, Reason::kTooOld,
                  "the joint was stopped since this order was made: give it anew from the next state");
  if (auto verdict = check_sender(message, envelope.needed, requester, verifications_)) return verdict;
  return envelope.needs_joint ? check_owner(requester) : std::nullopt;
}

std::optional<Verdict> Admission::check_sender(const WireMessage& message, Role needed, Requester& requester,
                                               TokenBucket& verifications) {
  if (is_unsigned(payload(message))) {
    if (!security_.unsigned_allowed)
      return refuse(
          requester, Reason::kUnsigned,
          "this daemon obeys signed orders only: strainwavectl --key FILE, see strainwavectl keygen --help");
    return check_sequence(unsigned_sequences_, requester.sender_id, requester);
  }
  const auto key = security_.keys.find(key_id_of(payload(message)));
  if (!key)
    return refuse(
        requester, Reason::kBadSignature,
        "signed with a key that is not in this daemon's security.authorized_keys: add its public line there "
        "and start the daemon again");
  if (!verifications.available(now_ns_))
    return refuse(requester, Reason::kBusy, "too many forged or repeated orders at once: try again");
  auto verdict = check_signed(message, *key, needed, requester);
  if (verdict) verifications.take();
  return verdict;
}

std::optional<Verdict> Admission::check_signed(const WireMessage& message, std::size_t key, Role needed,
                                               Requester& requester) {
  const AuthorizedKey& signer = security_.keys[key];
  if (!verify(message.channel.view(), signer.key, payload(message)))
    return refuse(requester, Reason::kBadSignature,
                  "the signature is not that of this message on this channel by the key it names");
  if (signer.role < needed)
    return refuse(requester, Reason::kRoleNotAllowed,
                  "the key of " + signer.comment + " has the role " + std::string(to_text(signer.role)) +
                      ", this order needs " + std::string(to_text(needed)));
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
  Verdict verdict = refuse(requester, Reason::kOldSequence,
                           "sequence " + std::to_string(requester.sequence) +
                               " does not rise above the last of this key for this joint, " +
                               std::to_string(requester.last_sequence) + ": send above it");
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
  text << " has " << joints_[requester.joint].name << ": wait until he is silent for " << security_.lease_s
       << " s or releases it, or take it over with an engineer's key; a stop or hold is always possible";
  return refuse(requester, Reason::kNotOwner, text.str());
}

// Stopping is for everybody, whatever session they believe in, whatever they sent before and whoever they are: by torque taken
// away (disable), or under control (hold). Who proves who he is gets his answer however many others ask for one.
Verdict Admission::stop(const WireMessage& message, OrderKind kind, std::int64_t session_id,
                        std::int64_t challenge, Requester requester) {
  requester.stop = true;
  const bool meant_for_us = session_id == session_id_ && challenges_.expiry_cycle(challenge) >= 0;
  if (meant_for_us && !is_unsigned(payload(message)))
    (void)check_sender(message, Role::kOperator, requester, stop_verifications_);
  challenges_.stop(requester.joint);
  return pass(requester, kind, 0);
}

Verdict Admission::change_owner(Action action, const Requester& requester) {
  const Ownership::Holder sender{requester.key, requester.sender_id};
  if (action == Action::kTakeOver)
    ownership_.take(requester.joint, sender, now_ns_);
  else if (!ownership_.release(requester.joint, sender, now_ns_))
    return refuse(requester, Reason::kNotOwner, "only who has the joint can release it");
  Verdict verdict;
  verdict.kind = Verdict::Kind::kDone;
  verdict.requester = requester;
  return verdict;
}

Verdict Admission::judge_setpoint(std::size_t joint, const WireMessage& message) {
  const auto setpoint = decode_exactly<setpoint_v2>(payload(message));
  if (!setpoint) return discard(Reason::kMalformed);
  Requester requester{joint, setpoint->sender_id, setpoint->sequence, setpoint->acknowledge != 0};
  if (auto verdict = check_envelope(
          message, {setpoint->session_id, setpoint->challenge, Role::kOperator, true}, requester))
    return std::move(*verdict);
  if (!std::isfinite(setpoint->position_rad) || !std::isfinite(setpoint->valid_for_s) ||
      !std::isfinite(setpoint->speed_limit_rad_s) || !std::isfinite(setpoint->velocity_rad_s) ||
      !std::isfinite(setpoint->acceleration_rad_s2))
    return refuse(
        requester, Reason::kNotFinite,
        "position_rad, velocity_rad_s, acceleration_rad_s2, valid_for_s and speed_limit_rad_s must be "
        "finite numbers");
  const JointAdmission& limits = joints_[joint];
  std::ostringstream text;
  if (setpoint->position_rad < limits.position_min_rad || setpoint->position_rad > limits.position_max_rad) {
    text << "position_rad = " << setpoint->position_rad << ": from " << limits.position_min_rad << " to "
         << limits.position_max_rad << " is allowed (joint.limits of " << limits.name << ")";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (setpoint->valid_for_s < 0.0 || setpoint->valid_for_s > kMaxValidFor_s ||
      (setpoint->valid_for_s > 0.0) != (setpoint->stream_id != 0)) {
    text << "valid_for_s = " << setpoint->valid_for_s << " with stream_id = " << setpoint->stream_id
         << ": both 0 (a move), or a stream and at most " << kMaxValidFor_s << " s are allowed";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (setpoint->speed_limit_rad_s < 0.0 || setpoint->speed_limit_rad_s > limits.speed_limit_rad_s) {
    text << "speed_limit_rad_s = " << setpoint->speed_limit_rad_s << ": from 0 (no limit of its own) to "
         << limits.speed_limit_rad_s << " is allowed (joint.limits.speed_limit_rad_s of " << limits.name
         << ")";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (auto complaint = complaint_about_motion(*setpoint))
    return refuse(requester, Reason::kOutOfRange, *complaint);
  Verdict verdict = pass(requester, OrderKind::kSetpoint, setpoint->challenge);
  verdict.order.velocity_rad_s = setpoint->velocity_rad_s;
  verdict.order.acceleration_rad_s2 = setpoint->acceleration_rad_s2;
  verdict.order.derivatives = setpoint->derivatives;
  verdict.order.at_cycle = setpoint->at_cycle;
  verdict.order.stream_id = setpoint->stream_id;
  verdict.order.begins_stream = setpoint->begins_stream != 0;
  verdict.order.position_rad = setpoint->position_rad;
  verdict.order.valid_for_s = setpoint->valid_for_s;
  verdict.order.speed_limit_rad_s = setpoint->speed_limit_rad_s;
  return verdict;
}

Verdict Admission::judge_command(std::size_t joint, const WireMessage& message) {
  const auto command = decode_exactly<command_v1>(payload(message));
  if (!command) return discard(Reason::kMalformed);
  Requester requester{joint, command->sender_id, command->sequence};
  const auto action = static_cast<Action>(command->action);
  const auto kind = order_of(action);
  if (action == Action::kDisable || action == Action::kHold)
    return stop(message, *kind, command->session_id, command->challenge, requester);
  const bool engineers = action == Action::kRevertTable || action == Action::kTakeOver;
  if (auto verdict = check_envelope(message,
                                    {command->session_id, command->challenge,
                                     engineers ? Role::kEngineer : Role::kOperator, kind.has_value()},
                                    requester))
    return std::move(*verdict);
  if (action == Action::kTakeOver || action == Action::kRelease) return change_owner(action, requester);
  if (!kind)
    return refuse(requester, Reason::kUnknownAction,
                  "action = " + std::to_string(command->action) + ": see docs/messages.md");
  Verdict verdict = pass(requester, *kind, command->challenge);
  verdict.revert_table = action == Action::kRevertTable;
  return verdict;
}

Verdict Admission::judge_table_message(std::size_t joint, const WireMessage& message) {
  const auto table_message = decode_exactly<gain_table_v1>(payload(message));
  if (!table_message) return discard(Reason::kMalformed);
  Requester requester{joint, table_message->sender_id, table_message->sequence};
  if (auto verdict = check_envelope(
          message, {table_message->session_id, table_message->challenge, Role::kEngineer, true}, requester))
    return std::move(*verdict);
  auto table = std::make_unique<GainTable>(to_gain_table(*table_message));
  const TableVerdict judged = judge_table(*table, joints_[joint].plant, joints_[joint].torque_limit_Nm);
  if (judged.reason != Reason::kAccepted) return refuse(requester, judged.reason, judged.text);
  Verdict verdict = pass(requester, OrderKind::kUseTable, table_message->challenge);
  verdict.text = judged.text;
  verdict.table = std::move(table);
  return verdict;
}

Verdict Admission::judge_injection(std::size_t joint, const WireMessage& message) {
  const auto inject = decode_exactly<inject_v1>(payload(message));
  if (!inject) return discard(Reason::kMalformed);
  Requester requester{joint, inject->sender_id, inject->sequence};
  if (auto verdict =
          check_envelope(message, {inject->session_id, inject->challenge, Role::kEngineer, false}, requester))
    return std::move(*verdict);
  if (!joints_[joint].takes_injected_faults)
    return refuse(requester, Reason::kNotSimulated,
                  joints_[joint].name + " has a real drive: faults are not injected there");
  if (!std::isfinite(inject->for_s) || !std::isfinite(inject->amount))
    return refuse(requester, Reason::kNotFinite, "for_s and amount must be finite numbers");
  const auto kind = injected_fault_of(inject->kind);
  if (!kind)
    return refuse(requester, Reason::kUnknownAction,
                  "kind = " + std::to_string(inject->kind) + ": see docs/faults.md");
  const AmountRange range = amount_range(*kind);
  std::ostringstream text;
  if (inject->for_s < 0.0 || inject->for_s > kMaxInjection_s) {
    text << "for_s = " << inject->for_s << ": from 0 (until it is ended) to " << kMaxInjection_s
         << " is allowed";
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  if (inject->amount < range.min || inject->amount > range.max) {
    text << "amount = " << inject->amount << ": from " << range.min << " to " << range.max
         << " is allowed for " << to_text(*kind);
    return refuse(requester, Reason::kOutOfRange, text.str());
  }
  Verdict verdict = pass(requester, OrderKind::kInject, inject->challenge);
  verdict.order.injection = {*kind, 0.0, inject->for_s, inject->amount};
  return verdict;
}

}  // namespace strainwave
