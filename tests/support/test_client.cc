// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/test_client.h"

#include <poll.h>

#include <random>
#include <utility>

#include "base/durations.h"
#include "base/utime.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/gain_table_message.h"

namespace strainwave::testing {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::microseconds kRecent{200'000};
constexpr std::chrono::microseconds kNextChallenge{30'000};
constexpr std::chrono::microseconds kFirstState{10'000'000};

}  // namespace

TestClient::TestClient(std::string prefix, const std::string& lcm_url)
    : prefix_(std::move(prefix)),
      lcm_(lcm_url),
      sender_id_(static_cast<std::int64_t>(std::random_device{}()) + 1) {
  lcm_.subscribe(prefix_ + "\\.[^.]+\\.STATE", &TestClient::on_state, this)->setQueueCapacity(1000);
  lcm_.subscribe(prefix_ + "\\.[^.]+\\.ACK", &TestClient::on_ack, this);
  lcm_.subscribe(prefix_ + "\\.TIMING", &TestClient::on_timing, this);
}

void TestClient::pump(std::chrono::milliseconds duration) {
  const auto deadline = Clock::now() + duration;
  do {
    // In nanoseconds: a wait in whole milliseconds would spin through the last one.
    const std::chrono::nanoseconds left = deadline - Clock::now();
    const std::timespec timeout = to_timespec(std::max<std::int64_t>(0, left.count()));
    pollfd descriptor{lcm_.getFileno(), POLLIN, 0};
    if (::ppoll(&descriptor, 1, &timeout, nullptr) > 0) lcm_.handle();
  } while (Clock::now() < deadline);
}

bool TestClient::wait_for_state(const std::string& joint,
                                const std::function<bool(const state_v1&)>& condition,
                                std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (!(states_[joint] && condition(*states_[joint]))) {
    if (Clock::now() >= deadline) return false;
    pump(std::chrono::milliseconds(5));
  }
  return true;
}

bool TestClient::wait_for_mode(const std::string& joint, Mode mode, std::chrono::milliseconds timeout) {
  return wait_for_state(
      joint, [mode](const state_v1& state) { return state.mode == static_cast<std::int32_t>(mode); },
      timeout);
}

bool TestClient::wait_for_timing(std::chrono::milliseconds timeout) {
  timing_.reset();
  const auto deadline = Clock::now() + timeout;
  while (!timing_ && Clock::now() < deadline) pump(std::chrono::milliseconds(5));
  return timing_.has_value();
}

template <typename Message>
void TestClient::fill_envelope(const std::string& joint, Message& message) {
  // The quoted challenge must be recent. Waiting states are therefore read first, and one from before a pause of the test is ignored.
  for (pollfd waiting{lcm_.getFileno(), POLLIN, 0}; ::poll(&waiting, 1, 0) > 0;) lcm_.handle();
  // A challenge from before our own stop is also ignored: the daemon may have published it after the stop.
  const auto recent = [&] {
    return states_[joint] && utime_now() - heard_us_[joint] < kRecent.count() &&
           states_[joint]->challenge != stopped_challenge_[joint] &&
           utime_now() - stopped_us_[joint] >= kNextChallenge.count();
  };
  const auto deadline = Clock::now() + (states_[joint] ? kRecent : kFirstState);
  while (!recent() && Clock::now() < deadline) pump(std::chrono::milliseconds(5));
  message.session_id = states_[joint] ? states_[joint]->session_id : 0;
  message.challenge = states_[joint] ? states_[joint]->challenge : 0;
  message.sender_id = sender_id_;
  message.sequence = ++sequence_;
}

command_v1 TestClient::make_command(const std::string& joint, Action action) {
  command_v1 message{};
  fill_envelope(joint, message);
  message.action = static_cast<std::int32_t>(action);
  if (action == Action::kDisable || action == Action::kHold) note_stop(joint);
  return message;
}

setpoint_v1 TestClient::make_setpoint(const std::string& joint, double position_rad, double valid_for_s) {
  setpoint_v1 message{};
  fill_envelope(joint, message);
  message.position_rad = position_rad;
  message.valid_for_s = valid_for_s;
  message.acknowledge = 1;
  if (valid_for_s > 0.0) {
    message.stream_id = stream_id_;
    message.begins_stream = std::exchange(stream_begins_, false) ? 1 : 0;
    message.approach = message.begins_stream;
  }
  return message;
}

gain_table_v1 TestClient::make_table(const std::string& joint, const GainTable& table) {
  gain_table_v1 message = to_message(table);
  fill_envelope(joint, message);
  return message;
}

inject_v1 TestClient::make_injection(const std::string& joint, std::int32_t kind, double for_s,
                                     double amount) {
  inject_v1 message{};
  fill_envelope(joint, message);
  message.kind = kind;
  message.for_s = for_s;
  message.amount = amount;
  return message;
}

Answer TestClient::command(const std::string& joint, Action action) {
  const Answer answer = send_and_wait(joint, "COMMAND", make_command(joint, action));
  if (action == Action::kDisable || action == Action::kHold) note_stop(joint);
  return answer;
}

void TestClient::note_stop(const std::string& joint) {
  stopped_challenge_[joint] = states_[joint] ? states_[joint]->challenge : 0;
  stopped_us_[joint] = utime_now();
}

Answer TestClient::move(const std::string& joint, double position_rad, double valid_for_s) {
  return send_and_wait(joint, "SETPOINT", make_setpoint(joint, position_rad, valid_for_s));
}

Answer TestClient::load(const std::string& joint, const GainTable& table) {
  return send_and_wait(joint, "TABLE", make_table(joint, table));
}

Answer TestClient::wait_for_answer(std::int64_t sequence, std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (!acks_.contains(sequence)) {
    if (Clock::now() >= deadline) return {};
    pump(std::chrono::milliseconds(5));
  }
  const ack_v1& ack = acks_[sequence];
  return {ack.accepted == 1, static_cast<Reason>(ack.reason), reinterpret_cast<const char*>(ack.text)};
}

void TestClient::on_state(const lcm::ReceiveBuffer* buffer, const std::string& channel,
                          const state_v1* message) {
  const auto name = parse_channel(channel);
  if (!name) return;
  states_[name->joint] = *message;
  heard_us_[name->joint] = buffer->recv_utime;
  history_[name->joint].push_back(*message);
}

void TestClient::on_ack(const lcm::ReceiveBuffer*, const std::string&, const ack_v1* message) {
  if (message->sender_id == sender_id_) acks_[message->sequence] = *message;
}

void TestClient::on_timing(const lcm::ReceiveBuffer*, const std::string&, const timing_v1* message) {
  timing_ = *message;
}

}  // namespace strainwave::testing
