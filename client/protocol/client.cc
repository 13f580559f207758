// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "client/protocol/interrupt.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

// A daemon publishes all of its joints together. At the slowest sensible rate the next round comes within
// this time.
constexpr double kOtherJoints_s = 0.3;
// After a stop or a fault, one of the next two states has a new challenge.
constexpr double kSettles_s = 0.2;
// Largest number of refused stream samples that wait for take_refusal().
constexpr std::size_t kRefusals = 16;

}  // namespace

Client::Client(Connection& connection, const ClientOptions& options)
    : connection_(connection),
      options_(options),
      states_(connection),
      sender_(options.key_file),
      acknowledgements_(
          connection.subscribe(channel_pattern(options.prefix, channel_kind::kAck), &Client::on_ack, this)) {}

std::string Client::advice(std::string_view call, std::string_view command, const std::string& joint) const {
  return options_.names_commands ? fmt::format("strainwavectl {} {}", command, joint) : std::string(call);
}

const JointView& Client::wait_for_joint(const std::string& joint) {
  states_.keep(options_.prefix, joint);
  if (!wait_until([&] { return find(joint) != nullptr; }, Deadline(options_.timeout_s)))
    explain_silence(joint);
  return *find(joint);
}

std::vector<std::string> Client::wait_for_joints() {
  if (!wait_until([&] { return !states_.joints(options_.prefix).empty(); }, Deadline(options_.timeout_s))) {
    explain_silence("");
  }
  wait_until([] { return false; }, Deadline(kOtherJoints_s));
  return states_.joints(options_.prefix);
}

std::vector<JointName> Client::heard() const {
  std::vector<JointName> names;
  for (const std::string& prefix : states_.prefixes()) {
    if (!options_.all_prefixes && prefix != options_.prefix) continue;
    for (const std::string& joint : states_.joints(prefix)) names.push_back({prefix, joint});
  }
  return names;
}

std::vector<JointName> Client::wait_for_heard() {
  if (!wait_until([&] { return !heard().empty(); }, Deadline(options_.timeout_s))) explain_silence("");
  wait_until([] { return false; }, Deadline(kOtherJoints_s));
  return heard();
}

// A stop and a fault make earlier states invalid. An order must quote a state that came after the stop's
// answer. That state must not have the challenge of the first state with the fault.
const JointView& Client::wait_until_settled(const std::string& joint) {
  const JointView& view = wait_for_joint(joint);
  const auto stopped = stopped_.find(joint);
  const std::int64_t before = stopped == stopped_.end() ? 0 : stopped->second;
  wait_until([&] { return view.messages > before && view.state.challenge != view.fault_challenge; },
             Deadline(kSettles_s));
  return view;
}

// The daemon refused the order unread, because another program with this key was ahead.
bool Client::rises_above(const Answer& refusal) {
  if (refusal.reason != Reason::kOldSequence || !ack_) return false;
  sender_.rise_above(ack_->last_sequence);
  return true;
}

Answer Client::exchange(const std::string& joint, SealedMessage order, const Patience& patience) {
  ack_.reset();
  awaited_.emplace(connection_.publisher(), std::move(order),
                   channel(options_.prefix, joint, channel_kind::kAck), patience);
  while (!ack_ && awaited_->keep_on()) handle(awaited_->remaining_ms());
  awaited_.reset();
  if (ack_) return to_answer(*ack_);
  const JointView* const view = find(joint);
  if (view == nullptr) explain_silence(joint);
  const std::string silence = silence_of(*view, options_.timeout_s);
  throw NoAnswer(
      fmt::format(
          "{0}: no acknowledgement in {1} s, after {2} transmissions: {3} Whether the command was carried "
          "out is not known: see {4}",
          joint, patience.timeout_s, patience.transmissions,
          silence.empty() ? "the daemon publishes its state but does not answer; see its log."
                          : silence + "; is strainwaved running?",
          advice("Joint::state()", "status", joint)),
      joint);
}

std::optional<Answer> Client::take_refusal() {
  if (refusals_.empty()) return std::nullopt;
  const Answer oldest = refusals_.front();
  refusals_.pop_front();
  return oldest;
}

void Client::forget_sent() noexcept {
  sent_.fill(0);
  refusals_.clear();
}

void Client::catch_up() {
  std::size_t count = 0;
  while (count < Connection::kQueueCapacity && connection_.handle(0)) ++count;
}

void Client::handle(int timeout_ms) {
  connection_.handle(timeout_ms);
  if (interrupted()) throw ClientError(ExitStatus::kInterrupted, "interrupted");
}

void Client::on_ack(const ReceivedMessage& message) {
  const auto ack = decode_exactly<ack_v1>(message.bytes);
  if (!ack || ack->sender_id != sender_.sender_id()) return;
  const auto was_sent = [this](std::int64_t sequence) {
    return sequence != 0 && std::find(sent_.begin(), sent_.end(), sequence) != sent_.end();
  };
  if (awaited_ && awaited_->is_answer(*ack, message.channel)) {
    if (!ack_) ack_ = ack;
  } else if (ack->accepted != 1 && was_sent(ack->sequence)) {
    refusals_.push_back(to_answer(*ack));
    refusals_.back().overtaken =
        refusals_.back().reason == Reason::kOldSequence && was_sent(ack->last_sequence);
    if (refusals_.size() > kRefusals) refusals_.pop_front();
  }
}

void Client::explain_silence(const std::string& joint) const {
  const auto& prefix = options_.prefix;
  const std::vector<std::string> joints = states_.joints(prefix);
  if (!joints.empty()) {
    throw NoAnswer(
        fmt::format("no joint '{}' on prefix {}; its joints are: {}", joint, prefix, fmt::join(joints, ", ")),
        joint);
  }
  if (states_.another_version(prefix))
    throw NoAnswer(
        fmt::format("the daemon on prefix {} has another version than this program: its states have another "
                    "type than state_v1. Install the same version of both",
                    prefix));
  std::string message =
      fmt::format("no daemon on prefix {} in {} s ({}).", prefix, options_.timeout_s, connection_.url());
  if (const std::vector<std::string> prefixes = states_.prefixes(); !prefixes.empty()) {
    message +=
        fmt::format(" Daemons are heard on: {} (choose one by its prefix).", fmt::join(prefixes, ", "));
  } else {
    message += " Is strainwaved running, and are its lcm_url and prefix the same as here?";
  }
  throw NoAnswer(message);
}

}  // namespace strainwave
