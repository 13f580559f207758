// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/pending_order.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "base/printable.h"

namespace strainwave {

Answer to_answer(const ack_v1& ack) {
  const std::string text(std::begin(ack.text), std::end(ack.text));
  return {ack.accepted == 1, static_cast<Reason>(ack.reason), printable(text)};
}

std::string why_not(const Answer* answer) {
  if (answer == nullptr) return "no answer";
  return fmt::format("refused, {}{}{}", to_text(answer->reason), answer->text.empty() ? "" : ": ",
                     answer->text);
}

PendingOrder::PendingOrder(Publish publish, SealedMessage order, std::string ack_channel,
                           const Patience& patience)
    : publish_(std::move(publish)),
      order_(std::move(order)),
      ack_channel_(std::move(ack_channel)),
      most_transmissions_(patience.transmissions),
      repeat_s_(patience.timeout_s / patience.transmissions),
      next_(repeat_s_) {
  transmit();
}

bool PendingOrder::keep_on() {
  if (!next_.passed()) return true;
  if (transmissions_ >= most_transmissions_) return false;
  transmit();
  return true;
}

void PendingOrder::transmit() {
  publish_(order_.channel, order_.bytes);
  next_ = Deadline(repeat_s_);
  ++transmissions_;
}

}  // namespace strainwave
