// SPDX-License-Identifier: BSD-3-Clause
// The drive stops without its master by the deadline of its RPDO and by the supervision of our heartbeat. The tests also check which PDOs stay
// enabled.
#include <gtest/gtest.h>

#include <array>

#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

/// Returns the time until the drive has no torque, at most a second. Meanwhile a stranger imitates our heartbeat.
std::int64_t torque_ends_after_ns(DriveBench& bench) {
  const std::int64_t dead_ns = bench.can().now_ns();
  while (bench.node().drive().power() == can_nodes::PowerState::kOperationEnabled &&
         bench.can().now_ns() < dead_ns + 1'000'000'000) {
    bench.can().run_to(bench.can().now_ns() + 10'000'000);
    bench.can().send_as_stranger(canopen::heartbeat_frame(127, canopen::NmtState::kOperational));
  }
  return bench.can().now_ns() - dead_ns;
}

TEST(Cia402Deadline, ADeadMasterIsMissedThoughAnotherNodeSendsItsHeartbeat) {
  DriveBench bench({bench_drive(3)});
  bench.start();
  EXPECT_EQ(bench.node().dictionary().number({0x1400, 5}), 20);
  EXPECT_EQ(bench.said().find("1400h:05"), std::string::npos);
  ASSERT_TRUE(bench.enable());
  bench.run(50, {5.0, true});
  EXPECT_LE(torque_ends_after_ns(bench), 40'000'000);
}

TEST(Cia402Deadline, ADriveWithoutItIsTakenAndTheLogSaysWhatThatMeans) {
  for (const char* lacks :
       {"refuse 0x1400 5 0x06090011", "refuse 0x1400 5 0x06090030", "pretend 0x1400 5 0"}) {
    DriveBench bench({bench_drive(3)});
    bench.tell_node(lacks);
    bench.start();
    const std::string text = bench.said();
    EXPECT_NE(text.find("no deadline of RPDO1 (1400h:05)"), std::string::npos) << lacks << ": " << text;
    EXPECT_NE(text.find("150 ms"), std::string::npos) << text;
    EXPECT_TRUE(bench.enable());
  }
}

TEST(Cia402Deadline, OneClearingAfterALinkThatWasDownResetsTheDrivesOwnFaultAsWell) {
  BenchDrive drive = bench_drive(3);
  drive.config.abort_connection = cia402::AbortConnection::kFault;
  DriveBench bench({drive});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.can().set_down();
  bench.run(50, {5.0, true});
  EXPECT_EQ(bench.node().drive().power(), can_nodes::PowerState::kFault) << "it missed our orders";
  bench.can().set_up();
  bench.run(50, {0.0, false});
  bench.clear();
  EXPECT_TRUE(bench.enable());
}

TEST(Cia402Deadline, AnOrderlyEndIsNoFaultHoweverLongTheDriveTakesToAnswer) {
  for (const int answer_us : {0, 95'000}) {
    BenchDrive drive = bench_drive(3);
    drive.node.sdo_answer_us = answer_us;
    DriveBench bench({drive, bench_drive(4)});
    bench.start();
    ASSERT_TRUE(bench.enable(400));
    bench.run(20, {0.0, false});
    const std::int64_t end_ns = bench.can().now_ns();
    bench.end();
    bench.can().run_to(bench.can().now_ns() + 1'000'000'000);
    for (const std::uint32_t emergency : {0x83U, 0x84U})
      EXPECT_TRUE(bench.frames(emergency, end_ns).empty()) << answer_us;
    for (const std::size_t joint : {0U, 1U}) {
      EXPECT_EQ(bench.node(joint).nmt(), can_nodes::NmtState::kPreOperational);
      EXPECT_EQ(bench.node(joint).drive().power(), can_nodes::PowerState::kSwitchOnDisabled);
      EXPECT_EQ(bench.node(joint).dictionary().number({0x1016, 1}), 0);
    }
  }
}

TEST(Cia402Pdos, BeyondTheFourthAreSwitchedOff) {
  using can_nodes::Access;
  using can_nodes::DataType;
  DriveBench bench({bench_drive(3)});
  can_nodes::ObjectDictionary& dictionary = bench.node().dictionary();
  constexpr std::array<std::uint16_t, 5> kMore{0x1404, 0x1405, 0x1804, 0x1805, 0x1806};
  for (const std::uint16_t index : kMore)
    dictionary.add({index, 1}, {DataType::kUnsigned32, Access::kReadWrite, 0x383});
  bench.start();
  for (const std::uint16_t index : kMore)
    EXPECT_EQ(dictionary.number({index, 1}) >> 31 & 1, 1) << std::hex << index;
}

}  // namespace
}  // namespace strainwave::testing
