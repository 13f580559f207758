// SPDX-License-Identifier: BSD-3-Clause
// The cycle of a bus with working drives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/joint/reference_plant.h"
#include "tests/drivers/can/drive_bench.h"
#include "tests/support/allocation_trap.h"

namespace strainwave::testing {
namespace {

class Cia402Bus : public ::testing::Test {
 protected:
  DriveBench bench_{{bench_drive(3)}};
};

TEST_F(Cia402Bus, ShowsPositionTemperatureAndADisabledDriveAfterStart) {
  bench_.start();
  bench_.run(20, {0.0, false});
  EXPECT_TRUE(bench_.reading().has_position);
  EXPECT_FALSE(bench_.reading().has_velocity) << "the observer's task";
  EXPECT_EQ(bench_.reading().drive_state, DriveState::kDisabled);
  EXPECT_EQ(bench_.reading().fault, ActuatorFault::kNone);
  EXPECT_TRUE(bench_.reading().has_temperature);
  EXPECT_NEAR(bench_.reading().temperature_C, 25.0, 0.1);
}

TEST_F(Cia402Bus, EnablesInTheStandardsStepsWithoutTorque) {
  bench_.start();
  const std::int64_t since_ns = bench_.can().now_ns();
  bench_.run(5, {0.0, false});
  for (int i = 0; i < 100; ++i) bench_.step({5.0, true});
  std::vector<std::uint64_t> words;
  for (const CanFrame& frame : bench_.frames(0x203, since_ns)) {
    const std::uint64_t word = little_endian(frame.bytes.data(), 2);
    if (words.empty() || words.back() != word) words.push_back(word);
    if (word != 0x0F) {
      EXPECT_EQ(little_endian(&frame.bytes[2], 2), 0U) << "torque before operation";
    }
  }
  EXPECT_EQ(words, (std::vector<std::uint64_t>{0x00, 0x06, 0x07, 0x0F}));
  EXPECT_EQ(bench_.reading().drive_state, DriveState::kEnabled);
  EXPECT_NEAR(bench_.node().drive().torque_demand_Nm(), 5.0, 0.005);
}

TEST_F(Cia402Bus, MovesTheJointByTheTorqueThatWasOrdered) {
  bench_.start();
  ASSERT_TRUE(bench_.enable());
  bench_.run(48, {15.0, true});
  const double moved_rad = bench_.node().drive().plant().measured_position_rad();
  EXPECT_GT(moved_rad, 0.05);
  bench_.run(2, {15.0, true});
  // The next SYNC samples the position, and the bus reads it one period later.
  EXPECT_NEAR(bench_.reading().joint_position_rad, moved_rad, 1e-9);
  EXPECT_NEAR(bench_.reading().torque_applied_Nm, 15.0, 0.05);
}

TEST_F(Cia402Bus, TurnsTheOtherWayWhenTheDriveCountsAgainstTheJoint) {
  BenchDrive drive = bench_drive(3);
  drive.node.drive.joint_torque_per_drive_torque = -kReferenceGearRatio;
  drive.config.units.direction = -1;
  DriveBench bench({drive});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(50, {15.0, true});
  EXPECT_GT(bench.node().drive().plant().state().position_rad, 0.05);
  EXPECT_GT(bench.reading().joint_position_rad, 0.05);
}

TEST_F(Cia402Bus, UsesTheDrivesVelocityWhenItsUnitIsConfigured) {
  BenchDrive drive = bench_drive(3);
  drive.config.units.velocity_rad_s_per_unit = 2 * 3.14159265358979 / 320000;
  DriveBench bench({drive});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(50, {15.0, true});
  ASSERT_TRUE(bench.reading().has_velocity);
  const double velocity_rad_s = bench.node().drive().plant().state().velocity_rad_s;
  EXPECT_NEAR(bench.reading().joint_velocity_rad_s, velocity_rad_s, 0.2 * velocity_rad_s);
  EXPECT_NEAR(bench.reading().temperature_C, 25.0, 1.0);
}

TEST_F(Cia402Bus, EndsEachPeriodByOneSyncAfterTheOrdersOfAllJoints) {
  DriveBench bench({bench_drive(1), bench_drive(2), bench_drive(3)});
  bench.start();
  ASSERT_TRUE(bench.enable());
  const std::int64_t since_ns = bench.can().now_ns();
  bench.run(100, {1.0, true});
  std::string order;
  for (const VirtualCan::Entry& entry : bench.can().trace()) {
    if (entry.time_ns <= since_ns || entry.from_node) continue;
    if (entry.frame.id == 0x080) order += 'S';
    if (entry.frame.id > 0x200 && entry.frame.id < 0x280)
      order += static_cast<char>('0' + entry.frame.id - 0x200);
  }
  std::string expected;
  for (int i = 0; i < 100; ++i) expected += "123S";
  EXPECT_EQ(order, expected);
  for (std::size_t joint = 0; joint < 3; ++joint)
    EXPECT_NEAR(bench.node(joint).drive().torque_demand_Nm(), 1.0, 0.005);
}

TEST_F(Cia402Bus, MissesNoPositionInTenSeconds) {
  bench_.start();
  ASSERT_TRUE(bench_.enable());
  for (int i = 0; i < 10000; ++i) {
    bench_.step({std::sin(i * 0.01), true});
    ASSERT_TRUE(bench_.reading().has_position) << i;
    ASSERT_EQ(bench_.reading().fault, ActuatorFault::kNone) << i;
  }
  EXPECT_EQ(bench_.bus().counters().frames_dropped, 0);
}

TEST_F(Cia402Bus, SendsOurHeartbeatOnlyWhileTheLoopTurns) {
  bench_.start();
  std::int64_t since_ns = bench_.can().now_ns();
  bench_.run(1000, {0.0, false});
  EXPECT_NEAR(static_cast<double>(bench_.frames(0x77F, since_ns).size()), 20.0, 1.0);
  since_ns = bench_.can().now_ns() + 1;
  bench_.can().run_to(since_ns + 1'000'000'000);
  EXPECT_TRUE(bench_.frames(0x77F, since_ns).empty());
}

TEST_F(Cia402Bus, StopsADriveWhoseMasterIsGone) {
  bench_.start();
  ASSERT_TRUE(bench_.enable());
  bench_.run(100, {10.0, true});
  const std::int64_t gone_ns = bench_.can().now_ns();
  while (bench_.node().drive().power() == can_nodes::PowerState::kOperationEnabled)
    bench_.can().run_to(bench_.can().now_ns() + DriveBench::kPeriod_ns);
  EXPECT_LE(bench_.can().now_ns() - gone_ns, 152'000'000) << "1016h says 150 ms";
}

TEST_F(Cia402Bus, LeavesTheDriveDisabledAndWithoutAFaultAtTheEnd) {
  bench_.start();
  ASSERT_TRUE(bench_.enable());
  bench_.run(10, {1.0, true});
  bench_.end();
  EXPECT_EQ(bench_.node().drive().power(), can_nodes::PowerState::kSwitchOnDisabled);
  bench_.can().run_to(bench_.can().now_ns() + 1'000'000'000);
  for (const std::string& note : bench_.can().notes())
    EXPECT_EQ(note.find("heartbeat-lost"), std::string::npos);
}

/// A fixed-memory port for the loop. It echoes every sent frame and answers every SYNC with a position of an enabled drive.
class FixedPort final : public CanPort {
 public:
  SendResult send(const CanFrame& frame) noexcept override {
    if (count_ < queue_.size()) queue_[count_++] = {frame, 0, ReceivedFrame::Kind::kOwn, 0};
    if (frame.id != 0x080 || count_ == queue_.size()) return SendResult::kSent;
    CanFrame position;
    position.id = 0x183;
    position.size = 8;
    position.bytes[4] = 0x27;
    queue_[count_++] = {position, 0, ReceivedFrame::Kind::kData, 0};
    const CanFrame heartbeat = canopen::heartbeat_frame(3, canopen::NmtState::kOperational);
    if (count_ < queue_.size()) queue_[count_++] = {heartbeat, 0, ReceivedFrame::Kind::kData, 0};
    return SendResult::kSent;
  }
  ReceiveResult receive(std::span<ReceivedFrame> frames) noexcept override {
    const std::size_t count = std::min(frames.size(), count_);
    std::copy_n(queue_.begin(), count, frames.begin());
    count_ = 0;
    return {count, CanLink::kUp};
  }
  std::uint32_t overflows() const noexcept override { return 0; }
  bool wait(std::int64_t /*timeout_ns*/) override { return false; }
  std::int64_t now_ns() override { return 0; }

 private:
  std::array<ReceivedFrame, 32> queue_;
  std::size_t count_ = 0;
};

TEST_F(Cia402Bus, AllocatesNothingInItsCycle) {
  if (!AllocationTrap::available()) GTEST_SKIP() << "the sanitizer has its own allocator";
  std::vector<std::unique_ptr<CanNode>> nodes;
  nodes.push_back(std::make_unique<cia402::Node>(bench_.config()));
  const CanPortFactory real = bench_.can().factory();
  const CanPortFactory open = [&](const CanPortOptions& options) -> std::unique_ptr<CanPort> {
    // Only the loop opens an urgent port.
    if (options.urgent) return std::make_unique<FixedPort>();
    return real(options);
  };
  CanBus bus(bench_.bus_config(), std::move(nodes), open);
  const std::unique_ptr<Actuator> joint = bus.make_actuator(0);
  ActuatorReading reading;
  {
    const AllocationTrap trap;
    for (std::int64_t now_ns = 2'000'000'000; now_ns < 2'300'000'000; now_ns += 1'000'000) {
      bus.begin_cycle(now_ns);
      reading = joint->read(now_ns);
      joint->write({1.0, true});
      if (now_ns % 100'000'000 == 0) joint->stop();
      bus.end_cycle();
      if (now_ns % 150'000'000 == 0) joint->clear_fault();
    }
    EXPECT_EQ(trap.touches(), 0);
  }
  EXPECT_TRUE(reading.has_position);
}

TEST(CanBusLoad, IsLoggedAtStartAndRefusedAboveItsLimit) {
  DriveBench bench({bench_drive(1), bench_drive(2), bench_drive(3)});
  bench.bus_config().load_limit = 0.85;
  bench.start();
  const std::vector<std::string> messages = bench.bus().take_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("% of 1000000 bit/s"), std::string::npos) << messages[0];
  DriveBench slow({bench_drive(1), bench_drive(2), bench_drive(3)});
  slow.bus_config().bit_rate = 500'000;
  slow.bus_config().load_limit = 0.85;
  EXPECT_NE(slow.start_refusal().find("load_limit"), std::string::npos);
}

}  // namespace
}  // namespace strainwave::testing
