// SPDX-License-Identifier: BSD-3-Clause
// Another master on the bus takes our drive out of the operational state while it has torque, with one frame: 000#8003. The drive then ignores
// process data and keeps its last order. The test judges the torque of the drive, not the reported state.
#include <gtest/gtest.h>

#include <cmath>

#include "drivers/can/can_detail.h"
#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

constexpr std::uint8_t kStop = 0x02;
constexpr std::uint8_t kPreOperational = 0x80;
constexpr std::uint8_t kResetCommunication = 0x82;

class ForeignNmtMaster : public ::testing::Test {
 protected:
  void begin(std::size_t drives = 1) {
    std::vector<BenchDrive> all;
    for (std::size_t i = 0; i < drives; ++i) all.push_back(bench_drive(static_cast<std::uint8_t>(3 + i)));
    bench_.emplace(all);
    bench_->start();
    ASSERT_TRUE(bench_->enable());
    bench_->run(50, kMoving);
    ASSERT_NEAR(bench_->node().drive().torque_demand_Nm(), 10.0, 0.01);
  }
  void order(std::uint8_t command, std::uint8_t node = 3) {
    CanFrame frame;
    frame.size = 2;
    frame.bytes = {command, node};
    bench_->can().send_as_stranger(frame);
  }
  /// Acts as the joint loop does: after a fault it stops the drive and orders nothing more.
  void run_as_the_loop(int periods) {
    for (int i = 0; i < periods; ++i) {
      const bool fault = bench_->reading().fault != ActuatorFault::kNone;
      if (fault && bench_->reading().drive_state != DriveState::kDisabled) bench_->actuator().stop();
      bench_->step(fault ? ActuatorCommand{} : kMoving);
    }
  }
  /// Returns the periods until the first drive has no torque. The torque must then stay off for two seconds.
  int periods_until_torque_ends(int limit) {
    for (int i = 1; i <= limit; ++i) {
      run_as_the_loop(1);
      if (torque_Nm() != 0.0) continue;
      for (int more = 0; more < 2000; ++more) {
        run_as_the_loop(1);
        EXPECT_EQ(torque_Nm(), 0.0) << more << " periods later";
      }
      return i;
    }
    return limit + 1;
  }
  double torque_Nm() { return bench_->node().drive().torque_demand_Nm(); }

  static constexpr ActuatorCommand kMoving{10.0, true};
  std::optional<DriveBench> bench_;
};

TEST_F(ForeignNmtMaster, WhoMakesADrivePreOperationalTakesItsTorqueWithinTenPeriods) {
  begin();
  order(kPreOperational);
  EXPECT_LE(periods_until_torque_ends(1000), 10);
  EXPECT_NE(bench_->reading().fault, ActuatorFault::kNone);
  EXPECT_EQ(bench_->reading().drive_state, DriveState::kDisabled) << "disable is obeyed";
}

TEST_F(ForeignNmtMaster, WhoStopsADriveOrResetsItsCommunicationTakesItsTorqueToo) {
  for (const std::uint8_t command : {kStop, kResetCommunication}) {
    begin();
    order(command);
    EXPECT_LE(periods_until_torque_ends(1000), 300) << int{command} << ": the drive brakes by itself";
    EXPECT_EQ(bench_->reading().drive_state, DriveState::kDisabled);
  }
}

TEST_F(ForeignNmtMaster, ADriveThatRefusesTheControlwordBySdoIsReset) {
  begin();
  bench_->tell_node("refuse 0x6040 0 0x08000022");
  order(kPreOperational);
  EXPECT_LE(periods_until_torque_ends(1000), 50);
}

TEST_F(ForeignNmtMaster, ADriveThatObeysNeitherLosesOurHeartbeatAndStopsForWantOfIt) {
  begin();
  bench_->tell_node("refuse 0x6040 0 0x08000022");
  order(kPreOperational);
  bench_->tell_node("ignore-nmt on");
  const std::int64_t since_ns = bench_->can().now_ns();
  EXPECT_LE(periods_until_torque_ends(3000), 1000);
  EXPECT_NE(bench_->node().drive().power(), can_nodes::PowerState::kOperationEnabled);
  const std::vector<CanFrame> heartbeats = bench_->frames(0x77F, since_ns);
  EXPECT_LE(heartbeats.size(), 8U) << "none after the first third of a second";
}

TEST_F(ForeignNmtMaster, TheOtherDrivesOfTheBusGoOnWhenOneIsTakenAway) {
  begin(2);
  order(kPreOperational);
  bench_->run(1000, kMoving);
  EXPECT_EQ(torque_Nm(), 0.0);
  EXPECT_EQ(bench_->reading(1).fault, ActuatorFault::kNone);
  EXPECT_NEAR(bench_->node(1).drive().torque_demand_Nm(), 10.0, 0.01);
}

TEST_F(ForeignNmtMaster, ADriveThatWasOutOfSightAndReturnsEndsNoOther) {
  begin(2);
  bench_->tell_node("cut");
  bench_->run(1000, kMoving);
  bench_->tell_node("reconnect");
  bench_->run(2000, kMoving);
  EXPECT_EQ(torque_Nm(), 0.0);
  EXPECT_EQ(bench_->reading(1).fault, ActuatorFault::kNone);
  EXPECT_NEAR(bench_->node(1).drive().torque_demand_Nm(), 10.0, 0.01);
}

TEST_F(ForeignNmtMaster, ClearingBringsTheDriveBack) {
  begin();
  order(kPreOperational);
  run_as_the_loop(500);
  bench_->clear(300);
  EXPECT_EQ(bench_->reading().fault, ActuatorFault::kNone) << can_detail_text(bench_->reading().drive_error);
  EXPECT_TRUE(bench_->enable());
}

TEST_F(ForeignNmtMaster, ADriveThatIsDisabledIsLeftAlone) {
  begin();
  for (int i = 0; i < 500; ++i) bench_->step({0.0, false});
  order(kPreOperational);
  const std::int64_t since_ns = bench_->can().now_ns() + 1;
  bench_->run(500, {0.0, false});
  EXPECT_TRUE(bench_->frames(0x603, since_ns).empty());
  EXPECT_TRUE(bench_->frames(0x000, since_ns).empty());
}

}  // namespace
}  // namespace strainwave::testing
