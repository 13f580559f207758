#include "daemon/gateway/gateway.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "base/utime.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr int kOrderQueue = 256;
constexpr int kMessagesPerTurn = 256;

constexpr const char* kRemedy =
    ": LCM needs a multicast route. On one machine: ip link set lo multicast on; "
    "ip route replace 239.255.76.67/32 dev lo src 127.0.0.1 (the service does this at boot). "
    "Or set daemon.lcm_url to an interface that has one.";

}  // namespace

Gateway::Gateway(const OutboundMemory& outbound, InboundMemory& inbound, int wake_fd)
    : outbound_(outbound),
      inbound_(inbound),
      wake_fd_(wake_fd),
      lcm_(std::string(outbound.lcm_url.view())),
      state_cursor_(outbound.states.written()),
      message_cursor_(outbound.messages.written()) {
  const std::string url(outbound_.lcm_url.view());
  if (!lcm_.good()) {
    problem_ = "LCM cannot be opened at " + url + kRemedy;
    return;
  }
  const std::string prefix(outbound_.prefix.view());
  for (const auto kind :
       {channel_kind::kSetpoint, channel_kind::kCommand, channel_kind::kTable, channel_kind::kInject}) {
    lcm::Subscription* subscription = lcm_.subscribe(channel_pattern(prefix, kind), &Gateway::on_order, this);
    if (subscription == nullptr) {
      problem_ = "LCM cannot receive at " + url + kRemedy;
      return;
    }
    subscription->setQueueCapacity(kOrderQueue);
  }
  lcm_.subscribe(channel_pattern(prefix, channel_kind::kState), &Gateway::on_state, this);
}

void Gateway::turn(int wait_ms) {
  receive(wait_ms);
  publish_states();
  publish_messages();
}

void Gateway::receive(int wait_ms) {
  pollfd descriptor{lcm_.getFileno(), POLLIN, 0};
  int wait = wait_ms;
  for (int i = 0; i < kMessagesPerTurn; ++i) {
    if (::poll(&descriptor, 1, wait) <= 0) return;
    lcm_.handle();
    wait = 0;
  }
}

void Gateway::on_order(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  if (buffer->data_size > WireMessage::kMaxBytes || channel.size() > kMaxChannelLength) return;
  const std::uint64_t index = inbound_.written.load(std::memory_order_relaxed);
  if (index - outbound_.inbound_taken.load(std::memory_order_acquire) >= InboundMemory::kMessages) {
    inbound_.overflow.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  WireMessage& slot = inbound_.messages[index % InboundMemory::kMessages];
  slot.channel = FixedString<64>(channel);
  slot.size = buffer->data_size;
  std::memcpy(slot.bytes.data(), buffer->data, buffer->data_size);
  inbound_.written.store(index + 1, std::memory_order_release);
  const std::uint64_t one = 1;
  if (::write(wake_fd_, &one, sizeof one) != sizeof one) return;  // the core also looks by itself
}

void Gateway::on_state(const lcm::ReceiveBuffer* buffer, const std::string& /*channel*/) {
  const auto* bytes = static_cast<const std::uint8_t*>(buffer->data);
  const auto state = decode_exactly<state_v1>({bytes, buffer->data_size});
  if (state && state->session_id != outbound_.session_id)
    inbound_.foreign_states.fetch_add(1, std::memory_order_relaxed);
}

void Gateway::publish_states() {
  StateRecord record{};
  while (outbound_.states.read(state_cursor_, record, states_dropped_)) {
    const auto joint = static_cast<std::size_t>(record.joint_index);
    if (joint >= outbound_.joint_count) continue;
    record.state.utime = utime_now();
    record.state.session_id = outbound_.session_id;
    lcm_.publish(channel(outbound_.prefix.view(), outbound_.joint_names[joint].view(), channel_kind::kState),
                 &record.state);
  }
  inbound_.state_records_dropped.store(states_dropped_, std::memory_order_relaxed);
}

void Gateway::publish_messages() {
  WireMessage message;
  while (outbound_.messages.read(message_cursor_, message, messages_dropped_)) {
    const auto size =
        static_cast<unsigned int>(std::min<std::uint64_t>(message.size, WireMessage::kMaxBytes));
    lcm_.publish(std::string(message.channel.view()), message.bytes.data(), size);
  }
}

}  // namespace strainwave
