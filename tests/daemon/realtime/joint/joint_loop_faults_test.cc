// SPDX-License-Identifier: BSD-3-Clause
// Injects every possible fault into the loop. Each ends in its documented reaction within its documented
// number of cycles, and nothing moves again by itself. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/daemon/realtime/joint/injected_fault_table.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

BenchJoint table_joint() {
  BenchJoint joint = demo_joint();
  joint.loop.temperature.max_age_s = kTableMaxAge_s;
  return joint;
}

class InjectedFaults : public ::testing::TestWithParam<InjectedFaultCase> {
 protected:
  InjectedFaults() : bench_({table_joint()}, {0.02, 0.1}) {}

  void SetUp() override {
    bench_.bring_to_hold(0);
    bench_.run(0.3);
    if (GetParam().doing == Doing::kMoving) {
      ASSERT_EQ(bench_.move(0, 3.0), Reason::kAccepted);
      bench_.run(0.15);
      ASSERT_EQ(bench_.mode(0), Mode::kTracking);
      ASSERT_GT(bench_.state(0).joint_velocity_rad_s, 3.0);
    }
    ASSERT_EQ(bench_.fault(0), Fault::kNone);
  }

  /// The last step made here has the first falsified reading.
  void begin() {
    ASSERT_EQ(bench_.inject(0, GetParam().injection), Reason::kAccepted);
    if (GetParam().doing == Doing::kHoldingThenMoving) {
      bench_.run(1.0);
      ASSERT_EQ(bench_.fault(0), Fault::kNone) << "nothing shows while the joint stands";
      ASSERT_EQ(bench_.move(0, 3.0), Reason::kAccepted);
    }
  }

  bool reacted() {
    switch (GetParam().reaction) {
      case Reaction::kFault:
        return bench_.fault(0) != Fault::kNone;
      case Reaction::kTemperatureUnknown:
        return bench_.state(0).temperature_status != static_cast<int>(TemperatureStatus::kValid);
      case Reaction::kNone:
        return false;
    }
    return false;
  }

  JointBench bench_;
};

TEST_P(InjectedFaults, EndInTheirDocumentedReactionWithinTheirDocumentedCycles) {
  const InjectedFaultCase& expected = GetParam();
  begin();
  const std::int64_t first_cycle = bench_.cycle();
  bench_.step_until([&] { return reacted(); }, 20000 * (expected.reaction == Reaction::kNone ? 0 : 1));
  if (expected.reaction == Reaction::kNone) {
    bench_.run(static_cast<double>(expected.within_cycles) * 0.001);
    EXPECT_EQ(bench_.fault(0), Fault::kNone);
    EXPECT_LT(std::abs(bench_.state(0).setpoint_position_rad -
                       bench_.drive(0).simulated().plant().state().position_rad),
              0.02);
    return;
  }
  ASSERT_TRUE(reacted());
  const std::int64_t cycles = bench_.cycle() - first_cycle + 1;
  RecordProperty("cycles", static_cast<int>(cycles));
  EXPECT_LE(cycles, expected.within_cycles);
  if (expected.reaction == Reaction::kTemperatureUnknown) {
    EXPECT_EQ(bench_.fault(0), Fault::kNone) << "the joint goes on";
    return;
  }
  EXPECT_NE(std::find(expected.faults.begin(), expected.faults.end(), bench_.fault(0)), expected.faults.end())
      << to_text(bench_.fault(0));
  EXPECT_EQ(bench_.mode(0), Mode::kFaulted);
  EXPECT_EQ(bench_.state(0).torque_commanded_Nm, 0.0);
  EXPECT_FALSE(bench_.drive(0).command().enable) << "the drive is off in the cycle of the fault";
  EXPECT_EQ(bench_.state(0).faults_total, 1);
}

class LatchedFaults : public InjectedFaults {};

TEST_P(LatchedFaults, LeaveTheJointAtRestUntilItIsClearedEnabledAndMovedByOrder) {
  begin();
  ASSERT_GE(bench_.step_until([&] { return reacted(); }, GetParam().within_cycles + 1), 0);
  const Fault first = bench_.fault(0);
  ASSERT_EQ(bench_.inject(0, {}), Reason::kAccepted) << "the cause goes away";
  bench_.run(2.0);
  EXPECT_EQ(bench_.mode(0), Mode::kFaulted);
  EXPECT_EQ(bench_.fault(0), first) << "latched";
  EXPECT_EQ(bench_.drive(0).simulated().plant().state().velocity_rad_s, 0.0)
      << "friction has stopped the joint";
  EXPECT_EQ(bench_.move(0, 0.0), Reason::kFaulted);
  EXPECT_EQ(bench_.order(0, OrderKind::kEnable), Reason::kFaulted);

  const double rest_rad = bench_.drive(0).simulated().plant().state().position_rad;
  ASSERT_EQ(bench_.order(0, OrderKind::kClearFault), Reason::kAccepted);
  bench_.run(1.0);
  EXPECT_EQ(bench_.mode(0), Mode::kOff);
  EXPECT_FALSE(bench_.drive(0).command().enable);
  ASSERT_EQ(bench_.order(0, OrderKind::kEnable), Reason::kAccepted);
  bench_.run(1.0);
  EXPECT_EQ(bench_.mode(0), Mode::kHolding);
  EXPECT_NEAR(bench_.drive(0).simulated().plant().state().position_rad, rest_rad, 1e-3)
      << "holds where it stands";
  EXPECT_EQ(bench_.move(0, 0.5), Reason::kAccepted);
  bench_.run(3.0);
  EXPECT_NEAR(bench_.state(0).joint_position_rad, 0.5, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Table, InjectedFaults, ::testing::ValuesIn(injected_fault_table()),
                         [](const auto& test) { return test.param.name; });

std::vector<InjectedFaultCase> latching_cases() {
  std::vector<InjectedFaultCase> cases = injected_fault_table();
  std::erase_if(cases, [](const InjectedFaultCase& entry) { return entry.reaction != Reaction::kFault; });
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Table, LatchedFaults, ::testing::ValuesIn(latching_cases()),
                         [](const auto& test) { return test.param.name; });

TEST(InjectedFaultTable, HasEveryKind) {
  for (std::int32_t kind = 1; kind < kInjectedFaultCount; ++kind) {
    const auto& table = injected_fault_table();
    EXPECT_TRUE(std::any_of(table.begin(), table.end(), [&](const InjectedFaultCase& entry) {
      return entry.injection.kind == static_cast<InjectedFault>(kind);
    })) << to_text(static_cast<InjectedFault>(kind));
  }
}

TEST(InjectedFaults, AreRefusedByAnotherDrive) {
  const BenchJoint joint = demo_joint();
  JointBench bench(joint.loop, std::make_unique<SimulatedActuator>(joint.drive));
  EXPECT_EQ(bench.inject(0, {InjectedFault::kPowerLost}), Reason::kNotSimulated);
}

}  // namespace
}  // namespace strainwave::testing
