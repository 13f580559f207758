// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/order_desk.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "client/protocol/orders.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

constexpr std::size_t kRefusalsKept = 8;
constexpr double kSaidFor_s = 10.0;

}  // namespace

OrderDesk::OrderDesk(Connection& connection, const StateView& states, const std::filesystem::path& key_file,
                     double timeout_s)
    : states_(states),
      sender_(key_file),
      orders_(connection.publisher(), sender_),
      timeout_s_(timeout_s),
      acknowledgements_(
          connection.subscribe(channel_pattern("[^.]+", channel_kind::kAck), &OrderDesk::on_ack, this)) {}

void OrderDesk::stop(const std::vector<Name>& joints) {
  if (joints.empty()) return;
  const auto batch = std::make_shared<Batch>(
      Batch{std::string(to_text(Action::kDisable)),
            joints.size() == 1 ? full_name(joints.front()) : fmt::format("{} joints", joints.size()),
            joints.size(),
            0,
            {}});
  for (const Name& joint : joints)
    post(
        joint,
        [this, joint, quoted = quote(joint)] {
          return sender_.seal_stop(channel(joint.first, joint.second, channel_kind::kCommand),
                                   command_message(Action::kDisable), quoted);
        },
        PendingOrder::stop_patience(timeout_s_), batch);
  report(*batch);
}

Quote OrderDesk::quote(const Name& joint) const {
  const JointView* view = states_.find(joint.first, joint.second);
  return view == nullptr ? Quote{} : quote_of(view->state);
}

template <typename Message>
void OrderDesk::post(const Name& joint, std::string_view kind, const Message& message, std::string what) {
  const auto batch = std::make_shared<Batch>(Batch{std::move(what), full_name(joint), 1, 0, {}});
  post(
      joint,
      [this, message, to = channel(joint.first, joint.second, kind), quoted = quote(joint)] {
        return sender_.seal(to, message, quoted);
      },
      PendingOrder::patience(encode(message).size(), timeout_s_), batch);
  report(*batch);
}

void OrderDesk::order(const Name& joint, Action action) {
  const JointView* view = states_.find(joint.first, joint.second);
  if (action == Action::kClearFault && view != nullptr && mode_of(*view) != Mode::kFaulted) {
    return say(full_name(joint) + ": has no fault", false);
  }
  post(joint, channel_kind::kCommand, command_message(action), std::string(to_text(action)));
}

void OrderDesk::move(const Name& joint, double position_rad) {
  setpoint_v1 message{};
  message.position_rad = position_rad;
  message.acknowledge = 1;
  post(joint, channel_kind::kSetpoint, message, fmt::format("move to {:.6g} rad", position_rad));
}

void OrderDesk::post(const Name& joint, OpenOrders::Seal seal, const Patience& patience,
                     std::shared_ptr<Batch> batch) {
  orders_.post(
      joint, std::move(seal), patience,
      [this, joint, batch = std::move(batch)](const Answer* answer) { conclude(joint, *batch, answer); });
}

void OrderDesk::conclude(const Name& joint, Batch& batch, const Answer* answer) {
  if (answer != nullptr && answer->accepted) {
    ++batch.accepted;
    return report(batch);
  }
  const std::string why = why_not(answer);
  refusals_.push_front({now(), fmt::format("{}: {}: {}", full_name(joint), batch.what, why)});
  if (refusals_.size() > kRefusalsKept) refusals_.pop_back();
  batch.failures.push_back(batch.joints == 1 ? why : full_name(joint) + ": " + why);
  report(batch);
}

std::string OrderDesk::message(Instant at) const {
  return orders_.size() == 0 && seconds_between(said_, at) > kSaidFor_s ? "" : message_;
}

void OrderDesk::say(std::string message, bool alarm) {
  message_ = std::move(message);
  alarm_ = alarm;
  said_ = now();
}

void OrderDesk::report(const Batch& batch) {
  const bool alarm = !batch.failures.empty();
  std::string text = batch.whose + ": " + batch.what;
  if (batch.accepted == 0 && !alarm) text += " sent";
  if (batch.accepted > 0)
    text += batch.accepted == batch.joints ? " accepted" : fmt::format(", {} accepted", batch.accepted);
  if (alarm) text += fmt::format("{}{}", batch.joints == 1 ? ": " : "; ", fmt::join(batch.failures, "; "));
  say(std::move(text), alarm);
}

void OrderDesk::on_ack(const ReceivedMessage& message) {
  if (const auto ack = decode_exactly<ack_v1>(message.bytes)) orders_.take(message.channel, *ack);
}

}  // namespace strainwave
