// SPDX-License-Identifier: BSD-3-Clause
// Drives that start and answer slowly, and the values that the background thread reads from them.
#include <gtest/gtest.h>

#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

std::int64_t entry(DriveBench& bench, std::uint16_t index, std::uint8_t sub_index = 0) {
  return bench.node().dictionary().number({index, sub_index});
}

TEST(Cia402SlowDrive, WaitsForADriveThatIsSlowToStartAndToBecomeOperational) {
  BenchDrive drive = bench_drive(3);
  drive.node.boot_us = 3'000'000;
  drive.node.start_us = 700'000;
  DriveBench bench({drive});
  bench.start();
  bench.run(500, {0.0, false});
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone) << can_detail_text(bench.reading().drive_error);
  EXPECT_TRUE(bench.enable());
}

TEST(Cia402SlowDrive, ADriveThatIsSlowToBecomeOperationalComesBackByClearingOnce) {
  BenchDrive drive = bench_drive(3);
  drive.node.start_us = 700'000;
  DriveBench bench({drive});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.tell_node("reboot 100");
  bench.run(300, {0.0, true});
  EXPECT_NE(bench.reading().fault, ActuatorFault::kNone);
  bench.clear();
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone) << can_detail_text(bench.reading().drive_error);
  EXPECT_TRUE(bench.enable());
}

TEST(Cia402SlowDrive, StartsWithinThirteenSecondsAtTheSlowestAnswersThatAreAllowed) {
  BenchDrive drive = bench_drive(3);
  drive.node.sdo_answer_us = 95'000;
  DriveBench bench({drive});
  const std::int64_t begun_ns = bench.can().now_ns();
  bench.start();
  EXPECT_LT(bench.can().now_ns() - begun_ns, 13'000'000'000);
  ASSERT_TRUE(bench.enable());
  bench.end();
  EXPECT_EQ(entry(bench, 0x1016, 1), 0) << "our going is no fault";
  EXPECT_EQ(bench.node().drive().power(), can_nodes::PowerState::kSwitchOnDisabled);
}

TEST(Cia402SlowDrive, IsRefusedUnchangedWhenItsAnswersStaySlow) {
  BenchDrive drive = bench_drive(3);
  drive.node.sdo_answer_us = 300'000;
  DriveBench bench({drive});
  expect_mentions(bench.start_refusal(), {"node 3", "300 ms", "100 ms", "boot_timeout_s"});
  EXPECT_LT(bench.can().now_ns(), 11'000'000'000);
  EXPECT_TRUE(bench.frames(0x000, 0).empty()) << "it has not been reset";
}

TEST(Cia402Background, ReadsATemperatureBySdoInTheBackground) {
  BenchDrive drive = bench_drive(3);
  drive.config.temperature->way = cia402::TemperatureObject::Way::kSdo;
  drive.config.temperature->period_s = 1.0;
  DriveBench bench({drive});
  bench.start();
  bench.run(5, {0.0, false});
  EXPECT_FALSE(bench.reading().has_temperature);
  bench.bus().serve();
  bench.run(100, {0.0, false});
  EXPECT_TRUE(bench.reading().has_temperature);
  EXPECT_NEAR(bench.reading().temperature_C, 25.0, 0.1);
  EXPECT_NEAR(static_cast<double>(bench.can().now_ns() - bench.reading().temperature_produced_ns), 100e6,
              2e6);
  const std::int64_t since_ns = bench.can().now_ns();
  bench.bus().serve();
  EXPECT_TRUE(bench.frames(0x603, since_ns).empty()) << "not before its period";
}

TEST(Cia402Background, SaysOnceThatTheTemperatureCannotBeRead) {
  BenchDrive drive = bench_drive(3);
  drive.config.temperature->way = cia402::TemperatureObject::Way::kSdo;
  drive.config.temperature->period_s = 0.1;
  DriveBench bench({drive});
  bench.start();
  bench.bus().take_messages();
  bench.tell_node("refuse 0x3201 1 0x08000024");
  for (int i = 0; i < 3; ++i) {
    bench.bus().serve();
    bench.run(150, {0.0, false});
  }
  const std::vector<std::string> messages = bench.bus().take_messages();
  ASSERT_EQ(messages.size(), 1U);
  expect_mentions(messages[0], {"3201h:01", "no data"});
}

}  // namespace
}  // namespace strainwave::testing
