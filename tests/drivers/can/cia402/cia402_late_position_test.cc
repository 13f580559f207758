// SPDX-License-Identifier: BSD-3-Clause
// Positions that arrive later than their SYNC suggests. The driver measures and reports their delay, and it faults above a limit.
#include "tests/drivers/can/cia402/cia402_failure.h"

namespace strainwave::testing {
namespace {

using Cia402LatePosition = Cia402Failure;

TEST_F(Cia402LatePosition, PositionsThatStayLateAreAFaultThoughOneComesInEveryPeriod) {
  for (const char* late : {"late-tpdo 2400 100000", "late-tpdo 10400 100000"}) {
    DriveBench bench({bench_drive(3)});
    bench.config().quick_stop_after = 20;  // otherwise the first gap would already be a fault
    bench.config().zero_torque_after = 2;
    bench.start();
    ASSERT_TRUE(bench.enable());
    bench.run(50, kMoving);
    bench.tell_node(late);
    const int periods = bench.periods_until_fault(100, kMoving);
    EXPECT_GT(periods, 0) << late;
    EXPECT_LE(periods, 20) << late;
    EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kPositionLate)
        << can_detail_text(bench.reading().drive_error);
  }
}

TEST_F(Cia402LatePosition, WholePeriodsOfLatenessAreSeenThoughThePlaceInThePeriodIsTheUsual) {
  DriveBench bench({bench_drive(3)});
  bench.config().quick_stop_after = 20;  // otherwise the first gap would already be a fault
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(50, kMoving);
  bench.tell_node("late-tpdo 3000 100000");
  const int periods = bench.periods_until_fault(100, kMoving);
  EXPECT_GT(periods, 0);
  EXPECT_LE(periods, 45) << "three TPDO2 of ten periods, and what they are late by";
  EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kPositionLate)
      << can_detail_text(bench.reading().drive_error);
  // After a new setup of the drive no position is late.
  bench.tell_node("late-tpdo 0 0");
  bench.run(50, {0.0, false});
  bench.clear();
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(bench.enable());
  bench.run(100, kMoving);
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  EXPECT_EQ(bench.reading().position_late_periods, 0);
}

TEST_F(Cia402LatePosition, APositionThatIsLateWithinDelayPeriodsIsToldWithItsDelayAndIsNoFault) {
  for (const auto& [late, delay_ms, periods] :
       {std::tuple{"late-tpdo 1400 100000", 1.4, 1}, std::tuple{"late-tpdo 2400 100000", 2.4, 2},
        std::tuple{"late-tpdo 2000 100000", 2.0, 2}}) {
    DriveBench bench({bench_drive(3)});
    bench.config().delay_periods = 3;
    bench.config().quick_stop_after = 20;
    bench.start();
    ASSERT_TRUE(bench.enable());
    bench.run(50, kMoving);
    EXPECT_EQ(bench.reading().position_late_periods, 0);
    EXPECT_LT(bench.reading().position_delay_ns, DriveBench::kPeriod_ns);
    bench.tell_node(late);
    EXPECT_EQ(bench.periods_until_fault(200, kMoving), 0) << late;
    EXPECT_EQ(bench.reading().position_late_periods, periods) << late;
    EXPECT_NEAR(static_cast<double>(bench.reading().position_delay_ns) * 1e-6, delay_ms, 0.2) << late;
  }
}

TEST_F(Cia402LatePosition, ADelayThatADriveHasFromTheStartIsPartOfDelayPeriods) {
  DriveBench bench({bench_drive(3)});
  bench.config().delay_periods = 3;
  bench.tell_node("late-tpdo 2400 100000");
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(200, kMoving);
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  EXPECT_EQ(bench.reading().position_late_periods, 0);
  EXPECT_NEAR(static_cast<double>(bench.reading().position_delay_ns) * 1e-6, 2.4, 0.2);
}

TEST_F(Cia402LatePosition, ADriveThatIsLateOnlyAtTheLoopsRateIsRefused) {
  for (const char* late : {"1400", "3000", "6400", "10400"}) {
    DriveBench bench({bench_drive(3)});
    // The drive answers a single SYNC at once. Only at the loop's rate is it late.
    bench.tell_node("late-tpdo-at-rate " + std::string(late));
    const std::string text = bench.start_refusal();
    EXPECT_NE(text.find("at the loop's rate"), std::string::npos) << late << ": " << text;
  }
}

TEST_F(Cia402LatePosition, ADriveThatBecomesLateWhileItIsOffIsAFaultOnceItIsUsed) {
  for (const char* late : {"1400", "3000", "6400", "10400"}) {
    DriveBench bench({bench_drive(3)});
    bench.config().quick_stop_after = 20;
    bench.start();
    bench.run(100, {0.0, false});
    bench.tell_node("late-tpdo " + std::string(late) + " 100000");
    bench.run(300, {0.0, false});
    EXPECT_FALSE(bench.enable()) << late;
    EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kPositionLate)
        << late << ": " << can_detail_text(bench.reading().drive_error);
  }
}

TEST_F(Cia402LatePosition, ADriveThatIsLateFromTheLoopsFirstPeriodIsAFaultOnceItIsUsed) {
  for (const char* late : {"1400", "2000", "3100", "6400", "10000", "10400"}) {
    DriveBench bench({bench_drive(3)});
    bench.config().quick_stop_after = 20;
    bench.start();
    bench.tell_node("late-tpdo " + std::string(late) + " 100000");
    bench.run(100, {0.0, false});
    EXPECT_FALSE(bench.enable()) << late;
    EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kPositionLate)
        << late << ": " << can_detail_text(bench.reading().drive_error);
  }
}

TEST_F(Cia402LatePosition, ADriveWhosePositionsAreLateFromTheStartIsRefusedWithTheirDelay) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("late-tpdo 2400 100000");
  const std::string text = bench.start_refusal();
  EXPECT_NE(text.find("2.4"), std::string::npos) << text;
  EXPECT_NE(text.find("delay_periods = 1"), std::string::npos) << text;
}

}  // namespace
}  // namespace strainwave::testing
