// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/commission/commission_loop.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "base/durations.h"
#include "base/input_error.h"
#include "daemon/realtime/loop/periodic_clock.h"
#include "daemon/realtime/loop/realtime_setup.h"

namespace strainwave {

namespace {

constexpr int kLook_ms = 20;
constexpr int kFirstPosition_ms = 5000;
constexpr int kSimulatedPeriods = 2000;  // between two checks for an interruption
constexpr int kDisablingPeriods = 500;   // time for the drives to disable

void sleep_ms(int duration_ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(duration_ms));
}

}  // namespace

CommissionLoop::CommissionLoop(const LoopConfig& config, LoopParts parts, std::size_t joint, bool simulated)
    : config_(config), parts_(std::move(parts)), joint_(joint), simulated_(simulated) {
  if (simulated) return;
  refusal_ = lock_memory();
  thread_ = std::thread([this] { thread_main(); });
  while (!set_up_.load(std::memory_order_acquire)) sleep_ms(1);
  const bool refused = !refusal_.empty() && config.real_time == RealTimePolicy::kEnforce;
  ending_ = refused;
  may_run_ = true;
  if (!refused) return;
  thread_.join();
  throw InputError("real time refused: " + refusal_ +
                   "; or set daemon.real_time = \"ignore\" (never with a real joint)");
}

CommissionLoop::~CommissionLoop() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
  for (const auto& bus : parts_.buses) bus->close();
}

void CommissionLoop::thread_main() {
  const std::string refused = make_thread_real_time(config_.priority, config_.cpu);
  if (refusal_.empty()) refusal_ = refused;
  set_up_ = true;
  while (!may_run_.load(std::memory_order_acquire)) sleep_ms(1);
  PeriodicClock clock(nanoseconds(config_.period_s));
  clock.start();
  for (int disabled = 0; disabled < kDisablingPeriods;) {
    const PeriodicClock::Wake wake = clock.wait();
    period(wake.instant_ns, wake.skipped);
    const bool end = ending_.load(std::memory_order_acquire) && moved_.load() == nullptr;
    disabled = end ? disabled + 1 : 0;
  }
  for (const JointParts& joint : parts_.joints) joint.actuator->stop();
  for (const auto& bus : parts_.buses) bus->end_cycle();
}

void CommissionLoop::period(std::int64_t now_ns, std::int64_t skipped) noexcept {
  Commissioning* const moved = moved_.load(std::memory_order_acquire);
  for (const auto& bus : parts_.buses) bus->begin_cycle(now_ns);
  for (std::size_t i = 0; i < parts_.joints.size(); ++i) {
    Actuator& actuator = *parts_.joints[i].actuator;
    const ActuatorReading reading = actuator.read(now_ns);
    ActuatorCommand command;
    if (i == joint_) {
      position_rad_.store(reading.joint_position_rad, std::memory_order_relaxed);
      fault_.store(reading.fault, std::memory_order_relaxed);
      if (reading.has_position) positioned_.store(true, std::memory_order_release);
      if (moved != nullptr) {
        if (const char* const why = interruption_.exchange(nullptr)) moved->abort(why);
        // A trace with a gap cannot be evaluated.
        if (skipped > 0)
          moved->abort("the loop missed a period: commissioning needs real time (docs/performance.md)");
        command = moved->step(reading);
      }
    }
    actuator.write(command);
  }
  for (const auto& bus : parts_.buses) bus->end_cycle();
  if (moved != nullptr && !moved->moves()) moved_.store(nullptr, std::memory_order_release);
}

void CommissionLoop::simulate_period() {
  period(simulated_ns_, 0);
  simulated_ns_ += nanoseconds(config_.period_s);
}

double CommissionLoop::first_position_rad() {
  for (int waited_ms = 0; !positioned_.load(std::memory_order_acquire) && waited_ms < kFirstPosition_ms;
       waited_ms += simulated_ ? 1 : kLook_ms)
    simulated_ ? simulate_period() : sleep_ms(kLook_ms);
  if (const ActuatorFault fault = fault_.load(); fault != ActuatorFault::kNone)
    throw NotAchieved(fmt::format("the drive reports fault {}: see docs/faults.md", static_cast<int>(fault)));
  if (!positioned_.load(std::memory_order_acquire))
    throw NotAchieved("no position has come from the drive for 5 s: check its supply and the bus");
  return position_rad_.load();
}

const char* CommissionLoop::run(Commissioning& commissioning, Interruption& interruption) {
  const char* interrupted = nullptr;
  moved_.store(commissioning.moves() ? &commissioning : nullptr, std::memory_order_release);
  while (moved_.load(std::memory_order_acquire) != nullptr) {
    for (int i = 0; simulated_ && i < kSimulatedPeriods && moved_.load() != nullptr; ++i) simulate_period();
    if (const char* const why = interruption.wait(simulated_ ? 0 : kLook_ms)) {
      interrupted = why;
      interruption_.store(why);
    }
  }
  for (int i = 0; simulated_ && i < kDisablingPeriods; ++i) simulate_period();
  return interrupted;
}

std::vector<std::string> CommissionLoop::take_messages() {
  std::vector<std::string> lines;
  for (const auto& bus : parts_.buses)
    for (std::string& line : bus->take_messages()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace strainwave
