// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/realtime_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/durations.h"
#include "base/input_error.h"
#include "daemon/realtime/loop/realtime_setup.h"

namespace strainwave {

RealtimeLoop::RealtimeLoop(const LoopConfig& config, LoopParts parts,
                           decltype(OutboundMemory::states)& states)
    : config_(config),
      period_ns_(nanoseconds(config.period_s)),
      publish_every_(std::max<std::int64_t>(1, std::llround(1.0 / (config.period_s * config.state_rate_Hz)))),
      stop_deadline_periods_(0),
      states_(states),
      replies_(std::make_unique<ReplyQueue>()),
      events_(std::make_unique<EventQueue>()),
      statistics_(std::make_unique<LoopTotals>()),
      buses_(std::move(parts.buses)),
      overrun_watch_(config.overruns, config.period_s) {
  for (JointParts& joint : parts.joints) {
    joints_.push_back(std::make_unique<JointLoop>(static_cast<std::int64_t>(joints_.size()), joint.config,
                                                  std::move(joint.actuator), *replies_, *events_));
    recorders_.push_back(std::move(joint.recorder));
    if (recorders_.back() != nullptr) joints_.back()->record_into(*recorders_.back());
    // One second more than the slowest joint may take to stop. By then it has faulted and is off.
    const double allowed_s = joint.config.stop_timeout_s + 1.0;
    stop_deadline_periods_ =
        std::max(stop_deadline_periods_, static_cast<std::int64_t>(allowed_s / config.period_s));
  }
  paths_ = std::make_unique<PathFollower>(joints_, config.period_s);
}

RealtimeLoop::~RealtimeLoop() {
  request_stop();
  signals_.may_run.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
}

void RealtimeLoop::start() {
  refusals_.real_time = lock_memory();
  awake_ = avoid_sleep_states(refusals_.sleep_states);
  thread_ = std::thread([this] { thread_main(); });
  while (!signals_.set_up.load(std::memory_order_acquire))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!refusals_.real_time.empty() && config_.real_time == RealTimePolicy::kEnforce) {
    request_stop();
    signals_.may_run.store(true, std::memory_order_release);
    thread_.join();
    throw InputError("real time refused: " + refusals_.real_time +
                     "; or set daemon.real_time = \"ignore\" (never with a real joint)");
  }
  signals_.may_run.store(true, std::memory_order_release);
}

void RealtimeLoop::thread_main() {
  const std::string refused = make_thread_real_time(config_.priority, config_.cpu);
  if (refusals_.real_time.empty()) refusals_.real_time = refused;
  signals_.set_up.store(true, std::memory_order_release);
  while (!signals_.may_run.load(std::memory_order_acquire))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  run();
  stop_drives();
  signals_.finished.store(true, std::memory_order_release);
}

void RealtimeLoop::run() noexcept {
  const long page_faults_before = thread_page_faults();
  PeriodicClock clock(period_ns_);
  clock.start();
  CycleTime time;
  for (;;) {
    const PeriodicClock::Wake wake = clock.wait();
    time.cycle += 1 + wake.skipped;
    time.elapsed_periods = 1 + wake.skipped;
    time.now_ns = wake.instant_ns;
    account_wake(wake, time);
    bring_to_rest_when_asked(time);
    for (const auto& bus : buses_) bus->begin_cycle(time.now_ns);
    paths_->advance(time);
    for (const auto& joint : joints_) joint->step(time);
    stop_groups_of_the_faulted(joints_, time);
    account_positions();
    for (const auto& bus : buses_) bus->end_cycle();
    publish(time);

    const bool at_rest = std::all_of(joints_.begin(), joints_.end(),
                                     [](const auto& joint) { return joint->joint().at_rest(); });
    const bool waited_enough = time.cycle - progress_.stop_since_cycle > stop_deadline_periods_;
    if (progress_.stop_since_cycle >= 0 && (at_rest || waited_enough)) return;

    statistics_->execution_time.add(monotonic_now_ns() - wake.woke_ns);
    statistics_->page_faults.store(thread_page_faults() - page_faults_before, std::memory_order_relaxed);
    statistics_->cycles.store(statistics_->cycles.load(std::memory_order_relaxed) + 1,
                              std::memory_order_release);
  }
}

void RealtimeLoop::close_buses() {
  for (const auto& bus : buses_) bus->close();
}

void RealtimeLoop::stop_drives() noexcept {
  for (const auto& joint : joints_) joint->joint().drive.stop();
  for (const auto& bus : buses_) bus->end_cycle();
}

void RealtimeLoop::account_wake(const PeriodicClock::Wake& wake, const CycleTime& time) noexcept {
  statistics_->cycle.store(time.cycle, std::memory_order_release);
  statistics_->wakeup_latency.add(wake.woke_ns - wake.due_ns);
  if (progress_.previous_wake_ns != 0)
    statistics_->period_error.add(std::abs(wake.woke_ns - progress_.previous_wake_ns - period_ns_));
  progress_.previous_wake_ns = wake.woke_ns;
  statistics_->overruns.store(statistics_->overruns.load(std::memory_order_relaxed) + wake.skipped,
                              std::memory_order_relaxed);
  const Fault fault = overrun_watch_.judge(wake.skipped);
  if (fault != Fault::kNone) fault_driven_joints(joints_, fault, time);
}

void RealtimeLoop::bring_to_rest_when_asked(const CycleTime& time) noexcept {
  if (!signals_.stop_requested.load(std::memory_order_acquire)) return;
  if (progress_.stop_since_cycle < 0) progress_.stop_since_cycle = time.cycle;
  for (const auto& joint : joints_) joint->end(time);
}

void RealtimeLoop::account_positions() noexcept {
  for (const auto& joint : joints_)
    if (const std::int64_t delay_ns = joint->joint().drive.position_delay_ns(); delay_ns > 0)
      statistics_->position_delay.add(delay_ns);
}

void RealtimeLoop::publish(const CycleTime& time) noexcept {
  if (time.cycle < progress_.next_publish_cycle) return;
  progress_.next_publish_cycle = time.cycle - time.cycle % publish_every_ + publish_every_;
  for (const auto& joint : joints_) states_.write(joint->record());
}

}  // namespace strainwave
