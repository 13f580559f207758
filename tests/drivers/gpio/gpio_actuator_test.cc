// SPDX-License-Identifier: BSD-3-Clause
// The whole driver in virtual time: real PWM and counter code on plain files, with fake lines and a fake encoder.
#include "drivers/gpio/gpio_actuator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/allocation_trap.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class FakeLines final : public DigitalLines {
 public:
  bool read(std::uint32_t& active) noexcept override {
    active = inputs;
    return !broken;
  }
  bool write(std::uint32_t active) noexcept override {
    outputs = active;
    return !broken;
  }
  bool out(LineRole role) const { return (outputs & bit(role)) != 0; }
  std::uint32_t inputs = 0;
  std::uint32_t outputs = 0;
  bool broken = false;
};

class FakeCounts final : public CountSource {
 public:
  Sample read(std::int64_t /*now_ns*/) noexcept override { return sample; }
  void clear_fault() noexcept override { ++clears; }
  Sample sample{0, State::kFresh};
  int clears = 0;
};

class GpioActuatorTest : public ::testing::Test {
 protected:
  GpioActuatorTest() {
    for (const char* name : {"enable", "duty_cycle", "period", "polarity"}) {
      std::filesystem::create_directories(folder_.path() / "pwmchip0/pwm0");
      std::ofstream(folder_.path() / "pwmchip0/pwm0" / name) << "0\n";
    }
    auto lines = std::make_unique<FakeLines>();
    auto counts = std::make_unique<FakeCounts>();
    lines_ = lines.get();
    counts_ = counts.get();
    torque_.full_scale_Nm = 9.6 * 5.0;
    GpioParts parts;
    parts.lines = std::move(lines);
    parts.counts = std::move(counts);
    parts.pwm =
        std::make_unique<PwmChannel>(PwmConfig{folder_.path() / "pwmchip0", 0, 20000.0, false}, 0.0, "pwm");
    GpioMotionConfig motion;
    motion.count_rad = 0.001;
    drive_ = std::make_unique<GpioActuator>(std::move(parts), motion, torque_,
                                            DriveSequenceConfig{0.002, 0.003, 0.003, 0.002, 0.004});
  }
  double duty() const {
    std::ifstream file(folder_.path() / "pwmchip0/pwm0/duty_cycle");
    double duty_ns = -1.0;
    file >> duty_ns;
    return duty_ns / 50000.0;
  }
  ActuatorReading cycle(bool enable, double torque_Nm = 0.0) {
    const ActuatorReading reading = drive_->read(now_ns_ += 1'000'000);
    drive_->write({torque_Nm, enable});
    return reading;
  }
  void switch_on() {
    for (int i = 0; i < 20; ++i) cycle(true);
    ASSERT_EQ(cycle(true).drive_state, DriveState::kEnabled);
  }
  bool outputs_safe() const { return duty() == 0.0 && !lines_->out(LineRole::kEnable); }

  TemporaryFolder folder_;
  TorqueOutputConfig torque_;
  FakeLines* lines_ = nullptr;
  FakeCounts* counts_ = nullptr;
  std::unique_ptr<GpioActuator> drive_;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(GpioActuatorTest, GivesTorqueBeforeTheBrakeOpensAndLetsTheJointMoveOnlyOnceItHas) {
  int held_periods = 0;
  for (int i = 0; i < 20; ++i) {
    const ActuatorReading reading = cycle(true, 20.0);
    const bool opens = lines_->out(LineRole::kBrakeRelease);
    if (duty() > 0.4 && !opens) ++held_periods;
    ASSERT_TRUE(!opens || duty() > 0.4) << i << ": the brake opens without torque";
    EXPECT_TRUE(opens || reading.drive_state != DriveState::kEnabled || reading.brake_shut) << i;
  }
  EXPECT_EQ(held_periods, 3);
  const ActuatorReading reading = cycle(true, 20.0);
  EXPECT_FALSE(reading.brake_shut);
  EXPECT_EQ(reading.drive_state, DriveState::kEnabled);
}

TEST_F(GpioActuatorTest, PutsTheTorqueOutAndTellsIt) {
  switch_on();
  cycle(true, 24.0);
  EXPECT_DOUBLE_EQ(duty(), 0.5);
  EXPECT_DOUBLE_EQ(cycle(true, 24.0).torque_applied_Nm, 24.0);
  for (int i = 0; i < 3; ++i) cycle(true, -24.0);
  EXPECT_TRUE(lines_->out(LineRole::kDirection));
}

TEST_F(GpioActuatorTest, IsSafeInTheCallThatStopsItAndShutsTheBrakeAfterItsDelay) {
  switch_on();
  cycle(true, 24.0);
  (void)drive_->read(now_ns_ += 1'000'000);
  drive_->stop();
  EXPECT_TRUE(outputs_safe());
  EXPECT_TRUE(lines_->out(LineRole::kBrakeRelease));
  for (int i = 0; i < 3; ++i) {
    cycle(false);
    EXPECT_TRUE(outputs_safe());
    EXPECT_TRUE(lines_->out(LineRole::kBrakeRelease)) << i;
  }
  cycle(false);
  cycle(false);
  EXPECT_FALSE(lines_->out(LineRole::kBrakeRelease));
}

TEST_F(GpioActuatorTest, ReportsEachInputAsWhatItIs) {
  switch_on();
  const std::pair<LineRole, ActuatorFault> faults[]{{LineRole::kEmergencyStop, ActuatorFault::kEmergencyStop},
                                                    {LineRole::kAmplifierFault, ActuatorFault::kDriveFault}};
  for (const auto& [role, fault] : faults) {
    lines_->inputs = bit(role);
    EXPECT_EQ(cycle(true).fault, fault);
    lines_->inputs = 0;
    EXPECT_EQ(cycle(true).fault, ActuatorFault::kNone);
  }
  lines_->inputs = bit(LineRole::kNegativeLimit) | bit(LineRole::kHome);
  const ActuatorReading reading = cycle(true);
  EXPECT_TRUE(reading.inputs.negative_limit);
  EXPECT_TRUE(reading.inputs.home);
  EXPECT_FALSE(reading.inputs.positive_limit);
  EXPECT_EQ(reading.fault, ActuatorFault::kNone);
}

TEST_F(GpioActuatorTest, BelievesAnAmplifiersFaultOnlyOnceItHasHadItsTimeToStart) {
  lines_->inputs = bit(LineRole::kAmplifierFault);
  EXPECT_EQ(cycle(false).fault, ActuatorFault::kNone);
  EXPECT_EQ(cycle(true).fault, ActuatorFault::kNone);
  for (int i = 0; i < 4; ++i) cycle(true);
  EXPECT_EQ(cycle(true).fault, ActuatorFault::kDriveFault);
}

TEST_F(GpioActuatorTest, LosesItsLinkWhenTheKernelRefusesTheLines) {
  switch_on();
  lines_->broken = true;
  EXPECT_EQ(cycle(true, 10.0).fault, ActuatorFault::kConnectionLost);
  EXPECT_EQ(cycle(true, 10.0).fault, ActuatorFault::kConnectionLost);
  EXPECT_EQ(duty(), 0.0) << "what can still be made safe is";
}

TEST_F(GpioActuatorTest, LatchesARefusedWriteUntilItIsCleared) {
  switch_on();
  lines_->broken = true;
  drive_->write({10.0, true});
  lines_->broken = false;
  EXPECT_EQ(cycle(true, 10.0).fault, ActuatorFault::kWriteRefused);
  drive_->clear_fault();
  EXPECT_EQ(cycle(false).fault, ActuatorFault::kNone);
  EXPECT_EQ(counts_->clears, 1);
}

TEST_F(GpioActuatorTest, TellsFreshFromStaleFromImplausiblePositions) {
  counts_->sample = {500, CountSource::State::kFresh};
  EXPECT_DOUBLE_EQ(cycle(false).joint_position_rad, 0.5);
  counts_->sample.state = CountSource::State::kStale;
  EXPECT_FALSE(cycle(false).has_position);
  EXPECT_EQ(cycle(false).fault, ActuatorFault::kNone);
  counts_->sample.state = CountSource::State::kImplausible;
  EXPECT_EQ(cycle(false).fault, ActuatorFault::kImplausible);
  lines_->inputs = bit(LineRole::kEmergencyStop);
  EXPECT_EQ(cycle(false).fault, ActuatorFault::kEmergencyStop) << "the cause that people must know first";
}

TEST_F(GpioActuatorTest, TogglesTheLineOfTheHardwareWatchdogEveryPeriodWhateverTheMode) {
  for (int i = 0; i < 20; ++i) {
    const bool before = lines_->out(LineRole::kAlive);
    cycle(i > 10);
    EXPECT_NE(lines_->out(LineRole::kAlive), before) << i;
  }
}

TEST_F(GpioActuatorTest, AllocatesNothingInTheLoop) {
  if (!AllocationTrap::available()) GTEST_SKIP() << "a sanitizer has its own allocator";
  const AllocationTrap trap;
  for (int i = 0; i < 200; ++i) {
    (void)drive_->read(now_ns_ += 1'000'000);
    drive_->write({20.0 * std::sin(0.1 * i), i < 150});
  }
  drive_->stop();
  drive_->clear_fault();
  EXPECT_EQ(trap.touches(), 0);
}

TEST(IndexCapture, PutsAPulseBetweenTwoSamplesByItsTime) {
  IndexCapture index;
  JointInputs inputs;
  index.sample(1.0, 1'000'000);
  index.sample(1.1, 2'000'000);
  index.fill(inputs);
  EXPECT_EQ(inputs.index_count, 0);
  index.pulse(2'250'000);
  index.sample(1.2, 3'000'000);
  index.fill(inputs);
  EXPECT_EQ(inputs.index_count, 1);
  EXPECT_NEAR(inputs.index_position_rad, 1.125, 1e-12);
}

}  // namespace
}  // namespace strainwave
