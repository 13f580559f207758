// SPDX-License-Identifier: BSD-3-Clause
// A joint whose drive sends its position by its own clock, once a period, as drives without SYNC do: where in the loop's
// period it falls nobody chooses, and now and then the loop finds none, then two. Virtual time.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <random>

#include "base/durations.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr std::int64_t kStep_ns = 50'000;
constexpr std::int64_t kPeriod_ns = 1'000'000;

/// Lives in steps of 50 us; sends position and velocity every period, `phase_steps` after the loop's, a step sooner or later by
/// chance. Carries the position to the loop's instant as the driver of such drives does.
class FreeRunningDrive final : public Actuator {
 public:
  FreeRunningDrive(std::int64_t phase_steps, std::uint64_t seed) : phase_steps_(phase_steps), random_(seed) {
    SimulatedActuatorConfig config = demo_joint().drive;
    const double steps = static_cast<double>(kPeriod_ns / kStep_ns);
    config.plant.period_s /= steps;
    config.plant.substeps = 1;
    config.plant.delay.periods = 0.5 * steps;  // of the bus and of the drive
    drive_.emplace(config);
  }

  ActuatorReading read(std::int64_t now_ns) noexcept override {
    if (lived_until_ns_ == 0) lived_until_ns_ = now_ns;
    for (; lived_until_ns_ < now_ns; lived_until_ns_ += kStep_ns) {
      const ActuatorReading reading = drive_->read(lived_until_ns_ + kStep_ns);
      if (++steps_ < next_sample_) continue;
      const std::int64_t periods = ++samples_;
      next_sample_ = periods * (kPeriod_ns / kStep_ns) + phase_steps_ + jitter_(random_);
      position_rad_ = reading.joint_position_rad;
      velocity_rad_s_ = drive_->plant().link_state().velocity_rad_s;
      sampled_ns_ = lived_until_ns_ + kStep_ns;
    }
    ActuatorReading reading = drive_->read(now_ns);
    const std::int64_t age_ns = now_ns - sampled_ns_;
    reading.has_position = age_ns < 2 * kPeriod_ns;
    // When exactly it was sampled nobody knows: other frames held it up.
    const std::int64_t taken_for_ns = age_ns + jitter_(random_) * kStep_ns;
    reading.joint_position_rad = position_rad_ + velocity_rad_s_ * seconds(taken_for_ns);
    reading.has_velocity = true;
    reading.joint_velocity_rad_s = velocity_rad_s_;
    return reading;
  }
  void write(const ActuatorCommand& command) noexcept override { drive_->write(command); }
  void stop() noexcept override { drive_->stop(); }
  void clear_fault() noexcept override { drive_->clear_fault(); }
  double true_position_rad() const { return drive_->plant().link_state().position_rad; }

 private:
  std::int64_t phase_steps_;
  std::mt19937_64 random_;
  std::uniform_int_distribution<std::int64_t> jitter_{-1, 1};
  std::optional<SimulatedActuator> drive_;
  std::int64_t lived_until_ns_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t samples_ = 0;
  std::int64_t next_sample_ = 0;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  std::int64_t sampled_ns_ = 0;
};

class Unsynchronised : public ::testing::TestWithParam<std::int64_t> {
 protected:
  Unsynchronised() {
    auto drive = std::make_unique<FreeRunningDrive>(GetParam(), 7);
    drive_ = drive.get();
    JointLoopConfig config = demo_joint().loop;
    loop_ = std::make_unique<JointLoop>(0, config, std::move(drive), replies_, events_);
    loop_->table_slot(0) = {demo_table(), 1};
    for (int k = 0; k < 50; ++k) step();
    EXPECT_EQ(order({.kind = OrderKind::kUseTable}), Reason::kAccepted);
  }
  void step() {
    const std::int64_t cycle = ++cycle_;
    loop_->step({1'000'000'000 + cycle * kPeriod_ns, cycle});
  }
  Reason order(Order order) {
    order.id = 1;
    loop_->orders().push(order);
    step();
    Reply reply;
    return replies_.pop(reply) ? reply.reason : Reason::kTimedOut;
  }

  ReplyQueue replies_;
  EventQueue events_;
  FreeRunningDrive* drive_ = nullptr;
  std::unique_ptr<JointLoop> loop_;
  std::int64_t cycle_ = 0;
};

TEST_P(Unsynchronised, ItIsEnabledAtAnyInstantAndArrivesWhereItIsSent) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    ASSERT_EQ(order({.kind = OrderKind::kEnable}), Reason::kAccepted) << attempt;
    for (int k = 0; k < 100; ++k) step();
    ASSERT_EQ(loop_->mode(), Mode::kHolding) << attempt;
    if (attempt == 19) break;
    ASSERT_EQ(order({.kind = OrderKind::kDisable}), Reason::kAccepted) << attempt;
    for (int k = 0; k < 20 + attempt; ++k) step();
    ASSERT_EQ(loop_->mode(), Mode::kOff);
  }
  for (const double target_rad : {0.01, 0.1, 1.0}) {
    ASSERT_EQ(order({.kind = OrderKind::kSetpoint, .position_rad = target_rad}), Reason::kAccepted);
    for (int k = 0; k < 1500; ++k) step();
    EXPECT_EQ(loop_->mode(), Mode::kHolding);
    EXPECT_EQ(static_cast<Fault>(loop_->record().state.fault), Fault::kNone);
    EXPECT_NEAR(drive_->true_position_rad(), target_rad, 5e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Phases, Unsynchronised, ::testing::Values(0, 1, 2, 5, 10, 15, 18, 19));

}  // namespace
}  // namespace strainwave::testing
