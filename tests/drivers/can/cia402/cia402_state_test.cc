// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_state.h"

#include <gtest/gtest.h>

#include "drivers/can/cia402/power_sequence.h"

namespace strainwave::cia402 {
namespace {

TEST(PowerState, IsReadFromTheBitsThatTheStandardNames) {
  const std::pair<std::uint16_t, PowerState> table[]{
      {0x0000, PowerState::kNotReady},
      {0x0040, PowerState::kSwitchOnDisabled},
      {0x0060, PowerState::kSwitchOnDisabled},
      {0x0021, PowerState::kReadyToSwitchOn},
      {0x0023, PowerState::kSwitchedOn},
      {0x0027, PowerState::kOperationEnabled},
      {0x0007, PowerState::kQuickStopActive},
      {0x000F, PowerState::kFaultReaction},
      {0x002F, PowerState::kFaultReaction},
      {0x0008, PowerState::kFault},
      {0x0028, PowerState::kFault},
  };
  for (const auto& [status, state] : table) {
    // Bits 4, 7 and above (voltage, warning, remote, target, vendor's) do not affect the state.
    for (const int others : {0x0000, 0x0010, 0x0090, 0xFF80, 0xFF90})
      EXPECT_EQ(power_state_of(static_cast<std::uint16_t>(status | others)), state)
          << status << ' ' << others;
  }
}

TEST(PowerState, GivesTorqueForNoBitsThatTheStandardDoesNotName) {
  for (std::uint32_t status = 0; status <= 0xFFFF; ++status) {
    if ((status & 0x6F) == 0x27) continue;
    EXPECT_NE(power_state_of(static_cast<std::uint16_t>(status)), PowerState::kOperationEnabled) << status;
  }
}

TEST(Controlword, LeadsFromDisabledToEnabledInTheStandardsThreeSteps) {
  EXPECT_EQ(controlword_towards(Goal::kEnabled, PowerState::kSwitchOnDisabled), 0x06);
  EXPECT_EQ(controlword_towards(Goal::kEnabled, PowerState::kReadyToSwitchOn), 0x07);
  EXPECT_EQ(controlword_towards(Goal::kEnabled, PowerState::kSwitchedOn), 0x0F);
  EXPECT_EQ(controlword_towards(Goal::kEnabled, PowerState::kOperationEnabled), 0x0F);
}

TEST(Controlword, NeverEnablesOnTheWayToAnyOtherGoal) {
  for (const Goal goal : {Goal::kDisabled, Goal::kQuickStop})
    for (int state = 0; state <= static_cast<int>(PowerState::kFault); ++state)
      EXPECT_NE(controlword_towards(goal, static_cast<PowerState>(state)), 0x0F);
  EXPECT_EQ(controlword_towards(Goal::kQuickStop, PowerState::kOperationEnabled), 0x02);
}

TEST(Controlword, NeverResetsAFaultByItself) {
  for (const Goal goal : {Goal::kDisabled, Goal::kEnabled, Goal::kQuickStop})
    for (int state = 0; state <= static_cast<int>(PowerState::kFault); ++state)
      EXPECT_EQ(controlword_towards(goal, static_cast<PowerState>(state)) & 0x80, 0);
}

class PowerSequenceTest : public ::testing::Test {
 protected:
  static constexpr std::int64_t kPeriod_ns = 1'000'000;
  std::uint16_t period(Goal goal, std::uint16_t statusword) {
    now_ns_ += kPeriod_ns;
    power_.see(statusword, now_ns_);
    return power_.controlword(goal, now_ns_);
  }
  std::int64_t now_ns_ = 0;
  PowerSequence power_{{500 * kPeriod_ns, 100 * kPeriod_ns, 50 * kPeriod_ns}};
};

TEST_F(PowerSequenceTest, GivesEachStepItsOwnTime) {
  period(Goal::kEnabled, 0x40);
  for (int i = 0; i < 400; ++i) period(Goal::kEnabled, 0x40);
  EXPECT_FALSE(power_.stuck(now_ns_));
  for (int i = 0; i < 400; ++i) period(Goal::kEnabled, 0x21);
  EXPECT_FALSE(power_.stuck(now_ns_));
  for (int i = 0; i < 102; ++i) period(Goal::kEnabled, 0x21);
  EXPECT_TRUE(power_.stuck(now_ns_));
}

TEST_F(PowerSequenceTest, TakesTheVoltageOffWhenAQuickStopLasts) {
  EXPECT_EQ(period(Goal::kQuickStop, 0x27), controlword::kQuickStop);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(period(Goal::kQuickStop, 0x07), controlword::kQuickStop);
  EXPECT_EQ(period(Goal::kQuickStop, 0x07), controlword::kDisableVoltage);
}

TEST_F(PowerSequenceTest, ResetsAFaultByRisingEdgesAndNoLongerThanItMay) {
  period(Goal::kDisabled, 0x08);
  power_.begin_reset(now_ns_);
  std::uint16_t previous = 0xFF;
  int edges = 0;
  for (int i = 0; i < 50; ++i) {
    const std::uint16_t word = period(Goal::kDisabled, 0x08);
    edges += (word & 0x80) != 0 && (previous & 0x80) == 0 ? 1 : 0;
    previous = word;
  }
  EXPECT_GE(edges, 2) << "one may be lost";
  period(Goal::kDisabled, 0x08);
  EXPECT_FALSE(power_.resetting());
  EXPECT_EQ(period(Goal::kDisabled, 0x08), controlword::kDisableVoltage);
}

TEST_F(PowerSequenceTest, EndsTheResetWithTheFault) {
  period(Goal::kDisabled, 0x08);
  power_.begin_reset(now_ns_);
  for (int i = 0; i < 8; ++i) period(Goal::kDisabled, 0x08);
  EXPECT_EQ(period(Goal::kDisabled, 0x40) & 0x80, 0);
  EXPECT_FALSE(power_.resetting());
}

TEST_F(PowerSequenceTest, KnowsADriveThatLeavesOperationByItself) {
  for (const int status : {0x40, 0x21, 0x23, 0x27})
    period(Goal::kEnabled, static_cast<std::uint16_t>(status));
  EXPECT_FALSE(power_.left_operation());
  period(Goal::kEnabled, 0x40);
  EXPECT_TRUE(power_.left_operation());
  period(Goal::kDisabled, 0x40);
  EXPECT_FALSE(power_.left_operation());
}

}  // namespace
}  // namespace strainwave::cia402
