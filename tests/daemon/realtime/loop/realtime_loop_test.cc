// SPDX-License-Identifier: BSD-3-Clause
// The loop's thread in real time: the order of its actions, its publications, and its end. The assertions do
// not depend on when the host runs it.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/input_error.h"
#include "daemon/realtime/loop/realtime_loop.h"
#include "drivers/fieldbus.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

/// The events in their order, without allocation: b begin, r read, w write, s stop, e end.
struct Journal {
  static constexpr std::size_t kRoom = 4096;
  std::array<char, kRoom> entries{};
  std::size_t count = 0;
  void add(char entry) noexcept {
    if (count < kRoom) entries[count++] = entry;
  }
  std::string text() const { return {entries.data(), count}; }
};

class JournalActuator final : public Actuator {
 public:
  explicit JournalActuator(Journal& journal) : journal_(journal) {}
  ActuatorReading read(std::int64_t /*now_ns*/) noexcept override {
    journal_.add('r');
    return {};
  }
  void write(const ActuatorCommand& /*command*/) noexcept override { journal_.add('w'); }
  void stop() noexcept override { journal_.add('s'); }
  void clear_fault() noexcept override {}

 private:
  Journal& journal_;
};

class JournalBus final : public Fieldbus {
 public:
  explicit JournalBus(Journal& journal) : journal_(journal) {}
  std::unique_ptr<Actuator> make_actuator(std::size_t /*slot*/) override {
    return std::make_unique<JournalActuator>(journal_);
  }
  void begin_cycle(std::int64_t now_ns) noexcept override {
    EXPECT_GT(now_ns, previous_ns_);
    previous_ns_ = now_ns;
    journal_.add('b');
  }
  void end_cycle() noexcept override { journal_.add('e'); }

 private:
  Journal& journal_;
  std::int64_t previous_ns_ = 0;
};

TEST(RealtimeLoop, PutsEveryJointOfABusBetweenItsBeginAndItsEnd) {
  Journal journal;
  LoopConfig config;
  config.real_time = RealTimePolicy::kIgnore;
  LoopParts parts;
  parts.buses.push_back(std::make_unique<JournalBus>(journal));
  for (std::size_t slot = 0; slot < 2; ++slot)
    parts.joints.push_back({demo_joint().loop, parts.buses[0]->make_actuator(slot), nullptr});
  const auto memory = std::make_unique<OutboundMemory>();
  {
    RealtimeLoop loop(config, std::move(parts), memory->states);
    loop.start();
    while (loop.statistics().cycles.load() < 20) std::this_thread::yield();
    loop.request_stop();
    while (!loop.finished()) std::this_thread::yield();
  }
  std::string expected;
  const std::string text = journal.text();
  const std::string last = "sse";
  ASSERT_GT(text.size(), last.size());
  while (expected.size() + last.size() < text.size()) expected += "brwrwe";
  EXPECT_EQ(text, expected + last);
}

/// The demo's simulated joint, with a stall of its drive on request.
class StallingActuator final : public Actuator {
 public:
  explicit StallingActuator(WatchedActuator& inner) : inner_(inner) {}
  ActuatorReading read(std::int64_t now_ns) noexcept override {
    if (stall_.exchange(false)) std::this_thread::sleep_for(kStall);
    return inner_.read(now_ns);
  }
  void write(const ActuatorCommand& command) noexcept override { inner_.write(command); }
  void stop() noexcept override { inner_.stop(); }
  void clear_fault() noexcept override { inner_.clear_fault(); }
  void stall() noexcept { stall_ = true; }

  static constexpr auto kStall = std::chrono::milliseconds(1500);

 private:
  WatchedActuator& inner_;
  std::atomic<bool> stall_{false};
};

/// A drive that stays powered and moves, whatever its orders.
class RunawayActuator final : public Actuator {
 public:
  ActuatorReading read(std::int64_t now_ns) noexcept override {
    ActuatorReading reading;
    reading.has_position = reading.has_temperature = true;
    reading.temperature_C = 25.0;
    reading.temperature_produced_ns = now_ns;
    if (enabled_) position_rad_ += 1e-4;
    reading.joint_position_rad = position_rad_;
    reading.drive_state = enabled_ ? DriveState::kEnabled : DriveState::kDisabled;
    return reading;
  }
  void write(const ActuatorCommand& command) noexcept override { enabled_ = enabled_ || command.enable; }
  void stop() noexcept override { ++stops; }
  void clear_fault() noexcept override {}
  int stops = 0;

 private:
  bool enabled_ = false;
  double position_rad_ = 0.0;
};

/// The demo's joints in a loop on a busy host, where late cycles are no fault.
class RunningLoop : public ::testing::Test {
 protected:
  RunningLoop() {
    config_.real_time = RealTimePolicy::kIgnore;
    config_.overruns = {1.0, 1.0};
  }
  ~RunningLoop() override { loop_.reset(); }

  void add_simulated_joint() {
    const BenchJoint joint = demo_joint();
    drives_.push_back(std::make_unique<WatchedActuator>(std::make_unique<SimulatedActuator>(joint.drive)));
    auto actuator = std::make_unique<StallingActuator>(*drives_.back());
    stalls_.push_back(actuator.get());
    parts_.joints.push_back({joint.loop, std::move(actuator), nullptr});
  }
  void start() {
    loop_ = std::make_unique<RealtimeLoop>(config_, std::move(parts_), memory_->states);
    for (std::size_t index = 0; index < loop_->joint_count(); ++index)
      loop_->joint(index).table_slot(0) = {demo_table(), 1};
    loop_->start();
  }
  Reason order(std::size_t joint, Order order) {
    order.id = ++order_id_;
    EXPECT_TRUE(loop_->joint(joint).orders().push(order));
    Reply reply;
    do {
      while (!loop_->replies().pop(reply)) std::this_thread::yield();
    } while (reply.id != order.id);
    return reply.reason;
  }
  Reason order(std::size_t joint, OrderKind kind) { return order(joint, Order{0, kind, 0, 0.0, 0.0, {}}); }
  /// The joint's next record for which `wanted` is true.
  template <class Wanted>
  state_v1 next_state(std::int64_t joint, Wanted wanted) {
    for (;;) {
      StateRecord record;
      if (!memory_->states.read(cursor_, record, dropped_))
        std::this_thread::yield();
      else if (record.joint_index == joint && wanted(record.state))
        return record.state;
    }
  }
  void hold(std::size_t joint) {
    ASSERT_EQ(order(joint, OrderKind::kUseTable), Reason::kAccepted);
    while (order(joint, OrderKind::kEnable) != Reason::kAccepted) std::this_thread::yield();
    (void)next_state(static_cast<std::int64_t>(joint),
                     [](const state_v1& state) { return is(state, Mode::kHolding); });
  }
  static bool is(const state_v1& state, Mode mode) { return state.mode == static_cast<std::int32_t>(mode); }
  void end() {
    loop_->request_stop();
    while (!loop_->finished()) std::this_thread::yield();
  }
  std::vector<StateRecord> records_left() {
    std::vector<StateRecord> records;
    for (StateRecord record; memory_->states.read(cursor_, record, dropped_);) records.push_back(record);
    return records;
  }

  LoopConfig config_;
  LoopParts parts_;
  std::vector<std::unique_ptr<WatchedActuator>> drives_;
  std::vector<StallingActuator*> stalls_;
  std::unique_ptr<OutboundMemory> memory_ = std::make_unique<OutboundMemory>();
  std::unique_ptr<RealtimeLoop> loop_;
  std::int64_t order_id_ = 0;
  std::uint64_t cursor_ = 0;
  std::uint64_t dropped_ = 0;
};

TEST_F(RunningLoop, BringsAMovingJointToRestBeforeItEnds) {
  config_.state_rate_Hz = 1.0 / config_.period_s;
  add_simulated_joint();
  start();
  hold(0);
  ASSERT_EQ(order(0, Order{0, OrderKind::kSetpoint, 0, 1.0, 0.0, {}}), Reason::kAccepted);
  (void)next_state(0, [](const state_v1& state) { return state.joint_velocity_rad_s > 0.5; });
  end();
  const std::vector<StateRecord> records = records_left();
  ASSERT_FALSE(records.empty());
  EXPECT_TRUE(is(records.back().state, Mode::kStopping) || is(records.back().state, Mode::kOff))
      << records.back().state.mode;
  EXPECT_LT(std::abs(records.back().state.joint_velocity_rad_s), 0.1) << "still driven while it moved";
  EXPECT_FALSE(drives_[0]->command().enable);
  EXPECT_GE(drives_[0]->stops(), 1);
}

TEST_F(RunningLoop, EndsAlsoWhenAJointNeverComesToRest) {
  JointParts runaway;
  runaway.config = demo_joint().loop;
  runaway.config.stop_timeout_s = 0.05;
  auto drive = std::make_unique<RunawayActuator>();
  RunawayActuator& stopped = *drive;
  runaway.actuator = std::move(drive);
  parts_.joints.push_back(std::move(runaway));
  start();
  ASSERT_EQ(order(0, OrderKind::kUseTable), Reason::kAccepted);
  while (order(0, OrderKind::kEnable) != Reason::kAccepted) std::this_thread::yield();
  end();
  EXPECT_GE(stopped.stops, 1);
}

TEST_F(RunningLoop, PublishesEveryJointOnceInAPeriodOfTheStateRate) {
  constexpr std::int64_t kEvery = 5;
  config_.state_rate_Hz = 200.0;
  add_simulated_joint();
  add_simulated_joint();
  start();
  while (loop_->statistics().cycles.load() < 200) std::this_thread::yield();
  end();
  const std::vector<StateRecord> records = records_left();
  ASSERT_GE(records.size(), 4U);
  for (std::size_t i = 0; i + 1 < records.size(); i += 2) {
    EXPECT_EQ(records[i].joint_index, 0);
    EXPECT_EQ(records[i + 1].joint_index, 1);
    EXPECT_EQ(records[i].state.cycle, records[i + 1].state.cycle);
    if (i == 0) continue;
    EXPECT_GT(records[i].state.cycle / kEvery, records[i - 2].state.cycle / kEvery);
  }
}

TEST_F(RunningLoop, FaultsWhatIsDrivenWhenItStalledAndNothingElse) {
  add_simulated_joint();
  add_simulated_joint();
  start();
  hold(0);
  stalls_[1]->stall();
  const state_v1 state = next_state(0, [](const state_v1& its) { return its.fault != 0; });
  EXPECT_EQ(state.fault, static_cast<std::int32_t>(Fault::kLoopStalled));
  const state_v1 other = next_state(1, [&](const state_v1& its) { return its.cycle >= state.cycle; });
  EXPECT_EQ(other.fault, 0) << "nothing drove it";
  EXPECT_GE(loop_->statistics().overruns.load(), 1000) << "of 1.5 s at 1 kHz";
}

TEST_F(RunningLoop, RefusesToStartWithoutRealTimeUnlessItIsToldToIgnoreIt) {
  constexpr int kNoSuchPriority = 1000;
  config_.priority = kNoSuchPriority;
  config_.real_time = RealTimePolicy::kEnforce;
  add_simulated_joint();
  EXPECT_THROW(start(), InputError);
  EXPECT_EQ(loop_->statistics().cycles.load(), 0) << "no cycle ran";

  config_.real_time = RealTimePolicy::kIgnore;
  add_simulated_joint();
  start();
  EXPECT_NE(loop_->real_time_refusal(), "");
  end();
}

TEST_F(RunningLoop, EndsThatNeverBegan) {
  add_simulated_joint();
  const RealtimeLoop never_started(config_, std::move(parts_), memory_->states);
  EXPECT_EQ(never_started.joint_count(), 1U);
  EXPECT_FALSE(never_started.finished());
}

}  // namespace
}  // namespace strainwave::testing
