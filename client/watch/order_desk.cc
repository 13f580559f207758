#include "client/watch/order_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <strainwave/command_v1.hpp>

#include "client/text/text.h"

namespace strainwave {

namespace {

command_v1 command(Action action) {
  command_v1 message{};
  message.action = static_cast<std::int32_t>(action);
  return message;
}

}  // namespace

OrderDesk::OrderDesk(Connection& connection, const std::filesystem::path& key_file, double timeout_s)
    : connection_(connection),
      sender_(key_file),
      repeat_s_(timeout_s / (1 + Client::kRepetitions)),
      acknowledgements_(
          connection.subscribe(channel_pattern("[^.]+", channel_kind::kAck), &OrderDesk::on_ack, this)) {}

void OrderDesk::stop(const std::string& prefix, const std::string& joint) {
  post(prefix, joint,
       sender_.seal_unsigned(channel(prefix, joint, channel_kind::kCommand), command(Action::kDisable), 0),
       Action::kDisable);
}

void OrderDesk::order(const std::string& prefix, const std::string& joint, std::int64_t session_id,
                      Action action) {
  post(prefix, joint,
       sender_.seal(channel(prefix, joint, channel_kind::kCommand), command(action), session_id), action);
}

void OrderDesk::post(const std::string& prefix, const std::string& joint, SealedMessage order,
                     Action action) {
  Waiting waiting{std::move(order), channel(prefix, joint, channel_kind::kAck),
                  fmt::format("{}.{}: {}", prefix, joint, to_text(action)), now(), 0};
  transmit(waiting);
  say(waiting.what + " sent", false);
  waiting_.push_back(std::move(waiting));
}

void OrderDesk::transmit(Waiting& waiting) {
  connection_.publish(waiting.order.channel, waiting.order.bytes);
  waiting.sent = now();
  ++waiting.transmissions;
}

void OrderDesk::tick() {
  for (Waiting& waiting : waiting_) {
    if (seconds_between(waiting.sent, now()) < repeat_s_) continue;
    if (waiting.transmissions <= Client::kRepetitions)
      transmit(waiting);
    else
      say(waiting.what + ": no answer", true);
  }
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    return waiting.transmissions > Client::kRepetitions && seconds_between(waiting.sent, now()) >= repeat_s_;
  });
}

void OrderDesk::say(const std::string& message, bool alarm) {
  message_ = message;
  alarm_ = alarm;
}

void OrderDesk::on_ack(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  const auto ack = decode_exactly<ack_v1>(payload(*buffer));
  if (!ack || ack->sender_id != sender_.sender_id()) return;
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return waiting.ack_channel == channel && waiting.order.sequence == ack->sequence;
  });
  if (found == waiting_.end()) return;
  const std::string text = printable(std::string(std::begin(ack->text), std::end(ack->text)));
  if (ack->accepted == 1)
    say(found->what + " accepted", false);
  else
    say(fmt::format("{} refused: {}{}{}", found->what, to_text(static_cast<Reason>(ack->reason)),
                    text.empty() ? "" : ": ", text),
        true);
  waiting_.erase(found);
}

}  // namespace strainwave
