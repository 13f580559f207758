// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/faulty_actuator.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
std::int64_t burned_ns = 0;
void burn(std::int64_t duration_ns) noexcept {
  burned_ns += duration_ns;
}

/// An actuator that moves by one unit a period and obeys every order.
class Moving final : public Actuator {
 public:
  ActuatorReading read(std::int64_t) noexcept override {
    ActuatorReading reading;
    reading.joint_position_rad = ++position;
    reading.has_position = true;
    reading.temperature_C = 20.0 + 0.001 * position;
    reading.has_temperature = true;
    reading.drive_state = command.enable ? DriveState::kEnabled : DriveState::kDisabled;
    return reading;
  }
  void write(const ActuatorCommand& order) noexcept override { command = order; }
  void stop() noexcept override { command = {}; }
  void clear_fault() noexcept override {}
  double position = 0.0;
  ActuatorCommand command;
};

class FaultyActuatorTest : public ::testing::Test {
 protected:
  void make(std::vector<Injection> schedule = {}) {
    burned_ns = 0;
    auto inner = std::make_unique<Moving>();
    moving_ = inner.get();
    actuator_ = std::make_unique<FaultyActuator>(std::move(inner),
                                                 FaultyActuatorConfig{0.001, std::move(schedule), &burn, 1});
  }
  ActuatorReading read() { return actuator_->read(now_ns_ += kPeriod_ns); }
  Moving* moving_ = nullptr;
  std::unique_ptr<FaultyActuator> actuator_;
  std::int64_t now_ns_ = 5'000'000'000;
};

TEST_F(FaultyActuatorTest, ChangesNothingUntilItIsTold) {
  make();
  for (int i = 1; i <= 100; ++i) {
    const ActuatorReading reading = read();
    EXPECT_EQ(reading.joint_position_rad, i);
    EXPECT_EQ(reading.fault, ActuatorFault::kNone);
    actuator_->write({0.5 * i, true});
    EXPECT_EQ(moving_->command.torque_Nm, 0.5 * i);
  }
  EXPECT_EQ(burned_ns, 0);
}

TEST_F(FaultyActuatorTest, BeginsAndEndsAsScheduled) {
  make({{InjectedFault::kSensorNan, 0.010, 0.005, 0.0}});
  for (int period = 0; period < 30; ++period)
    EXPECT_EQ(std::isnan(read().joint_position_rad), period >= 10 && period < 15) << period;
}

TEST_F(FaultyActuatorTest, HoldsAStuckSensorAtItsLastValue) {
  make();
  read();
  actuator_->inject({InjectedFault::kSensorStuck, 0.0, 0.0, 0.0});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(read().joint_position_rad, 2.0);
  actuator_->inject({});
  EXPECT_EQ(read().joint_position_rad, 12.0);
}

TEST_F(FaultyActuatorTest, DelaysByWholePeriodsOnceTheLineIsFull) {
  make();
  actuator_->inject({InjectedFault::kSensorDelayed, 0.0, 0.0, 0.003});
  const double expected[]{1, 1, 1, 1, 2, 3, 4};
  for (const double position : expected) EXPECT_EQ(read().joint_position_rad, position);
  for (int i = 0; i < 3000; ++i) read();
  EXPECT_EQ(read().joint_position_rad, 7 + 3001 - 3) << "also when the line has gone round";
}

TEST_F(FaultyActuatorTest, AddsNoiseOfTheGivenDeviation) {
  make();
  actuator_->inject({InjectedFault::kSensorNoisy, 0.0, 0.0, 0.1});
  double squares = 0.0;
  for (int i = 1; i <= 20000; ++i) squares += std::pow(read().joint_position_rad - i, 2);
  EXPECT_NEAR(std::sqrt(squares / 20000), 0.1, 0.002);
}

TEST_F(FaultyActuatorTest, OffsetsByAJump) {
  make();
  actuator_->inject({InjectedFault::kSensorJump, 0.0, 0.0, -0.25});
  EXPECT_EQ(read().joint_position_rad, 0.75);
  EXPECT_EQ(read().joint_position_rad, 1.75);
}

TEST_F(FaultyActuatorTest, FalsifiesTheTemperature) {
  make();
  actuator_->inject({InjectedFault::kTemperatureStuck, 0.0, 0.0, 0.0});
  const double stuck_C = read().temperature_C;
  read();
  EXPECT_EQ(read().temperature_C, stuck_C);
  actuator_->inject({});
  actuator_->inject({InjectedFault::kTemperatureDrifting, 0.0, 0.0, 100.0});
  read();
  for (int i = 0; i < 100; ++i) read();
  const double drifted_C = read().temperature_C;
  EXPECT_NEAR(drifted_C, 20.0 + 0.001 * moving_->position + 100.0 * 0.101, 1e-9);
  actuator_->inject({InjectedFault::kTemperatureLost, 0.0, 0.0, 0.0});
  EXPECT_FALSE(read().has_temperature);
}

TEST_F(FaultyActuatorTest, KeepsTheLastOrderWhileWritesAreRefusedButStillStops) {
  make();
  read();
  actuator_->write({1.0, true});
  actuator_->inject({InjectedFault::kWriteRefused, 0.0, 0.0, 0.0});
  read();
  actuator_->write({2.0, true});
  EXPECT_EQ(moving_->command.torque_Nm, 1.0);
  EXPECT_EQ(read().fault, ActuatorFault::kWriteRefused);
  actuator_->stop();
  EXPECT_FALSE(moving_->command.enable);
  actuator_->write({3.0, true});
  EXPECT_FALSE(moving_->command.enable) << "a refused order does not switch it on again";
}

TEST_F(FaultyActuatorTest, GivesNoTorqueWithoutPower) {
  make();
  actuator_->inject({InjectedFault::kPowerLost, 0.0, 0.0, 0.0});
  EXPECT_EQ(read().fault, ActuatorFault::kPowerLost);
  actuator_->write({1.0, true});
  EXPECT_FALSE(moving_->command.enable);
}

TEST_F(FaultyActuatorTest, BurnsTimeOnlyThroughTheCallersFunction) {
  make();
  actuator_->inject({InjectedFault::kOverrun, 0.0, 0.002, 0.0005});
  actuator_->inject({InjectedFault::kSlowRead, 0.0, 0.003, 0.0001});
  for (int i = 0; i < 10; ++i) {
    read();
    actuator_->write({});
  }
  EXPECT_EQ(burned_ns, 2 * 500'000 + 3 * 100'000);
}

TEST(InjectedFault, HasANameThatLeadsBackToIt) {
  for (std::int32_t number = 0; number < kInjectedFaultCount; ++number) {
    const auto kind = injected_fault_of(number);
    ASSERT_TRUE(kind);
    EXPECT_EQ(injected_fault_of(to_text(*kind)), kind);
  }
  EXPECT_FALSE(injected_fault_of(kInjectedFaultCount));
  EXPECT_FALSE(injected_fault_of(-1));
  EXPECT_FALSE(injected_fault_of("gremlin"));
}

}  // namespace
}  // namespace strainwave
