// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/fleet.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "lcmtypes/cycle_fields.h"

namespace strainwave {

namespace {

template <typename Counts>
bool counts_up(const Counts& counts) {
  return std::all_of(std::begin(counts), std::end(counts), [](std::int64_t count) { return count >= 0; });
}

/// Whether a count is negative, which no loop sends.
bool is_absurd(const timing_v1& timing) {
  return !counts_up(std::array{timing.cycles, timing.overruns, timing.page_faults,
                               timing.state_records_dropped, timing.wakeup_latency_max_ns,
                               timing.execution_time_max_ns, timing.position_delay_max_ns}) ||
         !counts_up(timing.wakeup_latency_count) || !counts_up(timing.execution_time_count) ||
         !counts_up(timing.period_error_count) || !counts_up(timing.position_delay_count) ||
         !counts_up(timing.rejects);
}

}  // namespace

void JointRecord::take(const state_v1& latest, double now_s) {
  state = latest;
  state_heard_s = now_s;
  torque_Nm.take(state.torque_commanded_Nm, now_s);
  tracking_error_rad.take(strainwave::tracking_error_rad(state), now_s);
}

void Fleet::take(const ChannelName& name, const state_v1& message, double now_s, const LcmSource& from) {
  if (message.faults_total < 0) return;
  const JointName joint(name.prefix, name.joint);
  if (const auto lost = joint_places_.take(joint, from, now_s)) joints_.erase(*lost);
  joints_[joint].take(message, now_s);
}

void Fleet::take(const ChannelName& name, const limits_v1& message, double, const LcmSource&) {
  const auto found = joints_.find({name.prefix, name.joint});
  if (found != joints_.end()) found->second.limits = message;
}

void Fleet::take(const ChannelName& name, const temperature_v1& message, double, const LcmSource&) {
  const auto found = joints_.find({name.prefix, name.joint});
  if (found != joints_.end()) found->second.temperature = message;
}

void Fleet::take(const ChannelName& name, const timing_v1& message, double now_s, const LcmSource& from) {
  if (!name.joint.empty() || is_absurd(message)) return;
  if (const auto lost = daemon_places_.take(name.prefix, from, now_s)) daemons_.erase(*lost);
  daemons_[name.prefix] = {message, now_s};
}

namespace {

template <typename Records, typename Places, typename HeardAt>
void forget(Records& records, Places& places, double before_s, const HeardAt& heard_s) {
  std::erase_if(records, [&](const auto& entry) {
    const bool silent = heard_s(entry.second) < before_s;
    if (silent) places.leave(entry.first);
    return silent;
  });
}

}  // namespace

void Fleet::forget_silent(double now_s) {
  const double before_s = now_s - kSilent_s;
  forget(joints_, joint_places_, before_s, [](const JointRecord& joint) { return joint.state_heard_s; });
  forget(daemons_, daemon_places_, before_s,
         [](const DaemonRecord& daemon) { return daemon.timing_heard_s; });
}

}  // namespace strainwave
