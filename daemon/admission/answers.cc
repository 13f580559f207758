// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/answers.h"

#include <algorithm>
#include <strainwave/ack_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>

#include "base/utime.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/wire.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxRemembered = 256;

}  // namespace

Answers::Answers(std::string prefix, std::int64_t session_id, std::vector<std::string> joints,
                 decltype(OutboundMemory::messages)& out)
    : prefix_(std::move(prefix)), session_id_(session_id), joints_(std::move(joints)), out_(out) {}

template <typename T>
WireMessage Answers::wire(const std::string& channel, const T& message) const {
  static_assert(sizeof(T) <= WireMessage::kMaxBytes);
  WireMessage result;
  result.channel = FixedString<64>(channel);
  const auto bytes = encode(message);
  result.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), result.bytes.begin());
  return result;
}

void Answers::answer(const Requester& to, Reason reason, const std::string& text) {
  if (reason == Reason::kAccepted && !to.wants_acknowledgement) return;
  ack_v1 ack{};
  ack.utime = utime_now();
  ack.session_id = session_id_;
  ack.sender_id = to.sender_id;
  ack.sequence = to.sequence;
  ack.last_sequence = reason == Reason::kOldSequence ? to.last_sequence : 0;
  ack.accepted = reason == Reason::kAccepted ? 1 : 0;
  ack.reason = static_cast<std::int32_t>(reason);
  std::copy_n(text.begin(), std::min(text.size(), sizeof ack.text - 1), ack.text);
  const WireMessage message = wire(channel(prefix_, joints_[to.joint], channel_kind::kAck), ack);
  if (to.authentic) {
    if (last_.size() >= kMaxRemembered && !last_.contains(to.sender_id)) last_.clear();
    last_[to.sender_id] = {to.sequence, message};
  }
  out_.write(message);
}

void Answers::repeat(const Requester& to) {
  const auto last = last_.find(to.sender_id);
  if (last != last_.end() && last->second.sequence == to.sequence) out_.write(last->second.message);
}

void Answers::temperature(const StateRecord& record) {
  temperature_v1 message{};
  message.utime = utime_now();
  message.temperature_measured_C = record.temperature_measured_C;
  message.temperature_used_C = record.state.temperature_used_C;
  message.age_s = record.temperature_age_s;
  message.status = record.state.temperature_status;
  const auto& joint = joints_[static_cast<std::size_t>(record.joint_index)];
  out_.write(wire(channel(prefix_, joint, channel_kind::kTemperature), message));
}

void Answers::limits(std::size_t joint, const PlantIdentity& plant, const JointLoopConfig& config) {
  const MotionLimits& motion = config.controller.motion;
  limits_v1 message{};
  message.utime = utime_now();
  message.session_id = session_id_;
  message.position_min_rad = config.limits.position_min_rad;
  message.position_max_rad = config.limits.position_max_rad;
  message.speed_limit_rad_s = motion.velocity_rad_s;
  message.acceleration_rad_s2 = motion.acceleration_rad_s2;
  message.deceleration_rad_s2 = motion.deceleration_rad_s2;
  message.torque_limit_Nm = config.controller.torque_limit_Nm;
  message.overspeed_rad_s = config.limits.overspeed_rad_s;
  message.following_error_rad = config.limits.following_error_rad;
  message.temperature_limit_C = config.limits.temperature_limit_C;
  message.period_s = plant.period_s;
  message.inertia_kgm2 = plant.inertia_kgm2;
  message.gear_ratio = plant.gear_ratio;
  const std::string_view model = plant.joint_model.view();
  std::copy_n(model.begin(), std::min(model.size(), sizeof message.joint_model - 1), message.joint_model);
  out_.write(wire(channel(prefix_, joints_[joint], channel_kind::kLimits), message));
}

void Answers::timing(const LoopTotals& statistics, const std::array<std::int64_t, kReasonCount>& rejects,
                     const LoopConfig& config, bool real_time, std::int64_t records_dropped) {
  static_assert(kHistogramBuckets == sizeof(timing_v1::wakeup_latency_count) / sizeof(std::int64_t));
  timing_v1 message{};
  message.utime = utime_now();
  message.session_id = session_id_;
  message.cycles = statistics.cycles.load(std::memory_order_relaxed);
  message.overruns = statistics.overruns.load(std::memory_order_relaxed);
  message.page_faults = statistics.page_faults.load(std::memory_order_relaxed);
  message.state_records_dropped = records_dropped;
  message.period_s = config.period_s;
  message.real_time = real_time ? 1 : 0;
  message.joint_count = static_cast<std::int32_t>(joints_.size());
  message.wakeup_latency_max_ns = statistics.wakeup_latency.max_ns();
  message.execution_time_max_ns = statistics.execution_time.max_ns();
  message.position_delay_max_ns = statistics.position_delay.max_ns();
  const auto copy = [](const HistogramCounts& counts, std::int64_t* to) {
    std::copy(counts.begin(), counts.end(), to);
  };
  copy(statistics.wakeup_latency.counts(), message.wakeup_latency_count);
  copy(statistics.execution_time.counts(), message.execution_time_count);
  copy(statistics.period_error.counts(), message.period_error_count);
  copy(statistics.position_delay.counts(), message.position_delay_count);
  std::copy(rejects.begin(), rejects.end(), message.rejects);
  out_.write(wire(timing_channel(prefix_), message));
}

}  // namespace strainwave
