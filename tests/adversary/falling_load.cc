// SPDX-License-Identifier: BSD-3-Clause
// A joint that carries a load of 15 N.m behind a brake: real loop, controller and GPIO driver, against the plant of this file. The load must not fall
// when the joint is enabled. The joint must not move while the brake opens or shuts, and a fault must not keep the brake open.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "drivers/gpio/gpio_actuator.h"
#include "tests/support/joint_bench.h"
#include "tests/support/temporary_folder.h"

namespace strainwave::testing {
namespace {

constexpr double kInertia_kgm2 = 0.089;
constexpr double kLoad_Nm = -15.0;
constexpr double kFriction_Nm = 3.0;
constexpr double kShutBrake_Nm = 60.0;
constexpr double kBrakeOpens_s = 0.05;
constexpr double kBrakeShuts_s = 0.03;
constexpr double kFullScale_Nm = 48.0;
constexpr double kCount_rad = 2.0 * std::numbers::pi / 320000.0;
/// Sag when the load is unknown, until the feedback carries it: 2.5 mrad measured.
constexpr double kSag_rad = 0.012;
/// Sag when the torque acts one period late and the assumed load has the wrong sign: 6.2 mrad measured.
constexpr double kDelayedSag_rad = 0.03;
/// Sag when the load is known: 41 urad measured, two counts.
constexpr double kKnownSag_rad = 0.0002;
/// Position error when the joint holds or has arrived: 9 urad measured.
constexpr double kHeld_rad = 1.2e-3;
constexpr int kSubsteps = 20;
constexpr double kPeriod_s = 0.001;

class Lines final : public DigitalLines {
 public:
  bool read(std::uint32_t& active) noexcept override {
    active = inputs;
    return true;
  }
  bool write(std::uint32_t active) noexcept override {
    outputs = active;
    return true;
  }
  bool out(LineRole role) const { return (outputs & bit(role)) != 0; }
  std::uint32_t inputs = 0;
  std::uint32_t outputs = 0;
};

/// Inertia, dry friction, a constant load, and a brake that needs time to open and to shut.
class Plant {
 public:
  void step(double motor_Nm, bool brake_current) {
    for (int i = 0; i < kSubsteps; ++i) substep(motor_Nm, brake_current, kPeriod_s / kSubsteps);
  }
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double fastest_rad_s = 0.0;
  double farthest_rad = 0.0;
  bool open = false;

 private:
  void substep(double motor_Nm, bool brake_current, double dt_s) {
    changing_s_ = brake_current == open ? 0.0 : changing_s_ + dt_s;
    if (changing_s_ >= (open ? kBrakeShuts_s : kBrakeOpens_s)) open = !open;
    const double holds_Nm = kFriction_Nm + (open ? 0.0 : kShutBrake_Nm);
    const double driving_Nm = motor_Nm + kLoad_Nm;
    const double stops_rad_s = holds_Nm / kInertia_kgm2 * dt_s;
    double next_rad_s = velocity_rad_s + driving_Nm / kInertia_kgm2 * dt_s;
    // Dry friction reduces the velocity to zero at most.
    next_rad_s -= std::clamp(next_rad_s, -stops_rad_s, stops_rad_s);
    velocity_rad_s = next_rad_s;
    fastest_rad_s = std::max(fastest_rad_s, std::abs(velocity_rad_s));
    position_rad += velocity_rad_s * dt_s;
    farthest_rad = std::max(farthest_rad, std::abs(position_rad));
  }
  double changing_s_ = 0.0;
};

/// Reading the counts at the end of a period advances the plant by that period.
class Counts final : public CountSource {
 public:
  Counts(const Plant& plant, std::function<void()> advance) : plant_(plant), advance_(std::move(advance)) {}
  Sample read(std::int64_t /*now_ns*/) noexcept override {
    advance_();
    return {static_cast<std::int64_t>(std::floor(plant_.position_rad / kCount_rad)), State::kFresh};
  }
  void clear_fault() noexcept override {}

 private:
  const Plant& plant_;
  std::function<void()> advance_;
};

class FallingLoad : public ::testing::Test {
 protected:
  FallingLoad() { make(0.0); }
  void make(double initial_load_Nm) {
    const std::filesystem::path pwm = folder_.path() / "pwmchip0/pwm0";
    std::filesystem::create_directories(pwm);
    for (const char* name : {"enable", "duty_cycle", "period", "polarity"})
      std::ofstream(pwm / name) << "0\n";
    GpioParts parts;
    auto lines = std::make_unique<Lines>();
    lines_ = lines.get();
    parts.lines = std::move(lines);
    parts.counts = std::make_unique<Counts>(plant_, [this] { advance(); });
    parts.pwm =
        std::make_unique<PwmChannel>(PwmConfig{folder_.path() / "pwmchip0", 0, 20000.0, false}, 0.0, "pwm");
    TorqueOutputConfig torque;
    torque.full_scale_Nm = kFullScale_Nm;
    GpioMotionConfig motion;
    motion.count_rad = kCount_rad;
    const DriveSequenceConfig sequence{0.01, 0.02, kBrakeOpens_s + 0.02, kBrakeShuts_s, 0.0};
    JointLoopConfig loop = demo_joint().loop;
    loop.controller.encoder_resolution_rad = kCount_rad;
    loop.controller.delay_periods = reckoned_periods_;
    loop.initial_load_Nm = initial_load_Nm;
    bench_.emplace(loop, std::make_unique<GpioActuator>(std::move(parts), motion, torque, sequence));
    bench_->joint(0).table_slot(0) = {demo_table(), 1};
    EXPECT_EQ(order(OrderKind::kUseTable), Reason::kAccepted);
  }

  void advance() {
    const double ordered_Nm = motor_Nm();
    plant_.step(delay_periods_ == 0 ? ordered_Nm : ordered_before_Nm_, lines_->out(LineRole::kBrakeRelease));
    ordered_before_Nm_ = ordered_Nm;
  }
  /// Returns how far the load sags at enabling. The torque acts `delay_periods` (0 or 1) late, and the control law assumes `reckoned` periods.
  double sag_rad(int delay_periods, int reckoned, double initial_load_Nm) {
    delay_periods_ = delay_periods;
    reckoned_periods_ = reckoned;
    plant_ = {};
    make(initial_load_Nm);
    EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
    run(1.0);
    EXPECT_TRUE(plant_.open);
    return plant_.farthest_rad;
  }
  void run(double duration_s) { bench_->run(duration_s); }
  Reason order(OrderKind kind) { return bench_->order(0, kind); }
  double motor_Nm() const {
    std::ifstream file(folder_.path() / "pwmchip0/pwm0/duty_cycle");
    double duty_ns = 0.0;
    file >> duty_ns;
    const double amount_Nm = lines_->out(LineRole::kEnable) ? duty_ns / 50000.0 * kFullScale_Nm : 0.0;
    return lines_->out(LineRole::kDirection) ? -amount_Nm : amount_Nm;
  }
  Mode mode() const { return bench_->mode(0); }

  TemporaryFolder folder_;
  int delay_periods_ = 0;     ///< delay of the plant
  int reckoned_periods_ = 0;  ///< delay that the control law assumes
  double ordered_before_Nm_ = 0.0;
  Plant plant_;
  Lines* lines_ = nullptr;
  std::optional<JointBench> bench_;
};

TEST_F(FallingLoad, EnablingHoldsItWhileTheBrakeOpensAndAfterwards) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(1.0);
  ASSERT_TRUE(plant_.open);
  EXPECT_EQ(mode(), Mode::kHolding);
  RecordProperty("sag_urad", static_cast<int>(1e6 * plant_.farthest_rad));
  EXPECT_LT(plant_.farthest_rad, kSag_rad) << "it fell 1.5 rad with the brake opened on zero torque";
  EXPECT_LT(plant_.fastest_rad_s, 1.0) << "and reached 17.9 rad/s";
}

TEST_F(FallingLoad, DoesNotSagWhenItsLoadIsKnown) {
  make(-kLoad_Nm);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(1.0);
  ASSERT_TRUE(plant_.open);
  RecordProperty("sag_urad", static_cast<int>(1e6 * plant_.farthest_rad));
  EXPECT_LT(plant_.farthest_rad, kKnownSag_rad);
}

// A delay that the control law knows causes no sag. An unknown delay makes the estimate of the load swing.
TEST_F(FallingLoad, ADelayCostsASagOnlyWhereTheControlLawDoesNotReckonWithIt) {
  for (const double load_Nm : {0.0, kLoad_Nm}) {
    const double reckoned_rad = sag_rad(1, 1, load_Nm);
    EXPECT_LT(reckoned_rad, kDelayedSag_rad) << load_Nm;
    EXPECT_EQ(mode(), Mode::kHolding);
  }
  for (const int reckoned_periods : {0, 1}) {
    EXPECT_LT(sag_rad(1, reckoned_periods, -kLoad_Nm), kKnownSag_rad)
        << "the load is known, the joint left alone";
    EXPECT_EQ(mode(), Mode::kHolding);
  }
}

TEST_F(FallingLoad, TheBrakeOpensUnderTheTorqueThatHoldsTheLoadFromTheFirstPeriodOn) {
  make(-kLoad_Nm);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  int held_periods = 0;
  for (; !lines_->out(LineRole::kBrakeRelease) && held_periods < 1000; bench_->step()) {
    if (mode() != Mode::kReleasing) continue;
    ++held_periods;
    EXPECT_NEAR(motor_Nm(), -kLoad_Nm, 0.5);
  }
  EXPECT_GE(held_periods, 10);
}

TEST_F(FallingLoad, IsKnownTheNextTimeFromWhatWasHeldBefore) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(3.0);
  ASSERT_EQ(order(OrderKind::kDisable), Reason::kAccepted);
  run(1.0);
  ASSERT_EQ(mode(), Mode::kOff);
  const double before_rad = plant_.position_rad;
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(1.0);
  ASSERT_TRUE(plant_.open);
  EXPECT_NEAR(plant_.position_rad, before_rad, 0.002);
}

TEST_F(FallingLoad, ATableThatCannotHoldItIsRefusedWhileItIsHeld) {
  make(-kLoad_Nm);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(1.0);
  ASSERT_EQ(mode(), Mode::kHolding);
  const Order swap{.kind = OrderKind::kUseTable, .table_slot = 1};
  bench_->joint(0).table_slot(1) = {demo_table(), 2};
  bench_->joint(0).table_slot(1).table.torque_limit_Nm = 8.0;
  EXPECT_EQ(bench_->order(0, swap), Reason::kOutOfRange);
  EXPECT_EQ(bench_->last_reply().value, 8.0);
  EXPECT_NEAR(bench_->last_reply().limit, -kLoad_Nm, 0.5);
  run(1.0);
  EXPECT_EQ(mode(), Mode::kHolding);
  bench_->joint(0).table_slot(1).table.torque_limit_Nm = 30.0;
  EXPECT_EQ(bench_->order(0, swap), Reason::kAccepted);
}

TEST_F(FallingLoad, NoMotionIsTakenBeforeTheBrakeIsOpen) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  int refusals = 0;
  while (!plant_.open) {
    EXPECT_EQ(bench_->move(0, 0.5), Reason::kWrongMode);
    ++refusals;
    ASSERT_LT(refusals, 1000);
  }
  EXPECT_GT(refusals, 50);
  EXPECT_LT(plant_.farthest_rad, kSag_rad);
  run(0.1);
  EXPECT_EQ(bench_->move(0, 0.5), Reason::kAccepted);
  run(3.0);
  RecordProperty("arrived_urad", static_cast<int>(1e6 * (plant_.position_rad - 0.5)));
  EXPECT_NEAR(plant_.position_rad, 0.5, kHeld_rad);
}

TEST_F(FallingLoad, AFaultShutsTheBrakeInThePeriodInWhichItComes) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(1.0);
  const double before_rad = plant_.position_rad;
  lines_->inputs = bit(LineRole::kEmergencyStop);
  bench_->step();
  EXPECT_EQ(mode(), Mode::kFaulted);
  EXPECT_FALSE(lines_->out(LineRole::kBrakeRelease));
  EXPECT_FALSE(lines_->out(LineRole::kEnable));
  run(1.0);
  EXPECT_EQ(plant_.velocity_rad_s, 0.0);
  // The load falls for 30 ms while the brake shuts, at (15 - 3) / 0.089 rad/s^2, and then the brake stops it.
  EXPECT_NEAR(plant_.position_rad, before_rad, 0.09);
}

TEST_F(FallingLoad, DisablingKeepsItHeldUntilTheBrakeIsShut) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  run(1.0);
  const double before_rad = plant_.position_rad;
  ASSERT_EQ(order(OrderKind::kDisable), Reason::kAccepted);
  run(1.0);
  EXPECT_FALSE(plant_.open);
  EXPECT_FALSE(lines_->out(LineRole::kEnable));
  RecordProperty("left_urad", static_cast<int>(1e6 * (plant_.position_rad - before_rad)));
  EXPECT_NEAR(plant_.position_rad, before_rad, kHeld_rad);
}

}  // namespace
}  // namespace strainwave::testing
