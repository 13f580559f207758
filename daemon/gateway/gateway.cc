// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/gateway.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "base/utime.h"
#include "daemon/gateway/order_lane.h"
#include "daemon/gateway/steady_now.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/multicast_check.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr std::size_t kDatagramsPerTurn = 256;
/// Ends a turn despite a backlog: on a busy processor it could otherwise publish for seconds while a stop waits.
constexpr std::size_t kStatesPerTurn = 64;
/// Enough for the largest bursts of several clients at once.
constexpr std::size_t kWaitingOrders = 256;
/// Number of ports that may send a stop at once: each has one turn.
constexpr std::size_t kWaitingStops = 256;

// Moves messages into a lane while it has room. Returns whether it moved any.
bool fill(InboundLane& lane, const std::atomic<std::uint64_t>& taken, OrderQueue& queue) noexcept {
  const std::uint64_t begin = lane.written.load(std::memory_order_relaxed);
  std::uint64_t index = begin;
  while (index - taken.load(std::memory_order_acquire) < InboundLane::kMessages &&
         queue.pop(lane.messages[index % InboundLane::kMessages]))
    lane.written.store(++index, std::memory_order_release);
  return index != begin;
}

}  // namespace

Gateway::Gateway(const OutboundMemory& outbound, InboundMemory& inbound, int wake_fd)
    : outbound_(outbound),
      inbound_(inbound),
      wake_fd_(wake_fd),
      lcm_(std::string(outbound.lcm_url.view())),
      reassembly_(WireMessage::kMaxBytes),
      stops_(kWaitingStops),
      orders_(kWaitingOrders),
      state_cursor_(outbound.states.written()),
      message_cursor_(outbound.messages.written()) {
  open_network();
}

void Gateway::open_network() {
  const std::string url(outbound_.lcm_url.view());
  const auto address = parse_udpm_url(url);
  if (!address) {
    problem_ = "daemon.lcm_url '" + url + "' does not have the form udpm://GROUP:PORT?ttl=N";
    return;
  }
  if (const auto problem = find_multicast_problem(url)) {
    problem_ = "LCM is not available on '" + url + "': " + *problem;
    return;
  }
  try {
    if (!lcm_.good()) throw std::system_error(ENETUNREACH, std::generic_category(), "opening LCM's sender");
    socket_ = std::make_unique<LcmSocket>(*address, largest_datagram(WireMessage::kMaxBytes));
  } catch (const std::system_error& error) {
    problem_ = "LCM cannot be opened on '" + url + "': " + error.what();
  }
}

bool Gateway::turn(int wait_ms) {
  pollfd descriptor{socket_->descriptor(), POLLIN, 0};
  if (::poll(&descriptor, 1, behind_ ? 0 : wait_ms) > 0) receive();
  hand_over();
  if (echo_.missing(steady_now_ns())) return false;
  // Answers go before states: they are few, and a client waits for each.
  publish_messages();
  behind_ = !publish_states();
  return true;
}

void Gateway::receive() {
  std::size_t received = 0;
  while (received < kDatagramsPerTurn) {
    const std::size_t batch = socket_->receive(
        [this](const LcmSource& from, std::span<const std::uint8_t> datagram) { sort(from, datagram); });
    if (batch == 0) break;
    received += batch;
    hand_over();
  }
  if (received >= kDatagramsPerTurn) echo_.heard();
  const LcmReassembly::Counts& counts = reassembly_.counts();
  inbound_.malformed.store(counts.malformed, std::memory_order_relaxed);
  inbound_.too_long.store(counts.too_long, std::memory_order_relaxed);
  inbound_.interrupted.store(counts.interrupted, std::memory_order_relaxed);
  inbound_.crowded_out.store(stops_.crowded_out() + orders_.crowded_out(), std::memory_order_relaxed);
}

void Gateway::sort(const LcmSource& from, std::span<const std::uint8_t> datagram) {
  const auto message = reassembly_.take(from, datagram);
  if (!message) return;
  switch (lane_of(outbound_.prefix.view(), message->channel, message->bytes)) {
    case OrderLane::kStop:
      return stops_.push(from, message->channel, message->bytes);
    case OrderLane::kOrder:
      return orders_.push(from, message->channel, message->bytes);
    case OrderLane::kState:
      return note_state(message->bytes);
    case OrderLane::kNone:
      return;
  }
}

void Gateway::note_state(std::span<const std::uint8_t> bytes) {
  const auto state = decode_exactly<state_v1>(bytes);
  if (!state) return;
  if (state->session_id == outbound_.session_id)
    echo_.heard();
  else
    inbound_.foreign_states.fetch_add(1, std::memory_order_relaxed);
}

void Gateway::hand_over() {
  const bool stops = fill(inbound_.stops, outbound_.stops_taken, stops_);
  const bool orders = fill(inbound_.orders, outbound_.orders_taken, orders_);
  if (!stops && !orders) return;
  const char byte = 0;
  if (::write(wake_fd_, &byte, 1) != 1) return;  // the pipe is full of wakes: the core will look anyway
}

bool Gateway::publish_states() {
  StateRecord record{};
  std::size_t taken = 0;
  while (taken < kStatesPerTurn && outbound_.states.read(state_cursor_, record, states_dropped_)) {
    ++taken;
    publish(record);
  }
  inbound_.state_records_dropped.store(states_dropped_, std::memory_order_relaxed);
  return taken < kStatesPerTurn;
}

void Gateway::publish(StateRecord& record) {
  const auto joint = static_cast<std::size_t>(record.joint_index);
  if (joint >= outbound_.joint_count) return;
  record.state.utime = utime_now();
  record.state.session_id = outbound_.session_id;
  record.state.challenge = outbound_.challenge.load(std::memory_order_relaxed);
  record.state.owner_id = outbound_.leases[joint].owner_id.load(std::memory_order_relaxed);
  record.state.lease_s = outbound_.leases[joint].lease_s.load(std::memory_order_relaxed);
  lcm_.publish(channel(outbound_.prefix.view(), outbound_.joint_names[joint].view(), channel_kind::kState),
               &record.state);
  echo_.published(steady_now_ns());
}

void Gateway::publish_messages() {
  WireMessage message;
  // A gateway that is too slow for these rare messages skips to newer ones. It does not count the lost ones.
  for (std::uint64_t dropped = 0; outbound_.messages.read(message_cursor_, message, dropped);) {
    const auto size =
        static_cast<unsigned int>(std::min<std::uint64_t>(message.size, WireMessage::kMaxBytes));
    lcm_.publish(std::string(message.channel.view()), message.bytes.data(), size);
  }
}

}  // namespace strainwave
