// SPDX-License-Identifier: BSD-3-Clause
// The setup of a drive at start-up: the changes, the requirements and the error messages.
#include <gtest/gtest.h>

#include "drivers/can/cia402/cia402_setup.h"
#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

std::int64_t entry(DriveBench& bench, std::uint16_t index, std::uint8_t sub_index = 0) {
  return bench.node().dictionary().number({index, sub_index});
}

TEST(Cia402Setup, WritesWhatTheDriveMustKnow) {
  BenchDrive drive = bench_drive(3);
  drive.config.quick_stop_option = 1;
  DriveBench bench({drive});
  bench.start();
  EXPECT_EQ(entry(bench, 0x1016, 1), 127 << 16 | 150) << "it supervises our heartbeat";
  EXPECT_EQ(entry(bench, 0x1017), 50);
  EXPECT_EQ(entry(bench, 0x6007), 3) << "quick stop when we vanish";
  EXPECT_EQ(entry(bench, 0x605A), 1);
  EXPECT_EQ(entry(bench, 0x6060), 10);
  EXPECT_EQ(entry(bench, 0x6072), 2083) << "20 of 9.6 N.m, rounded down";
  EXPECT_EQ(entry(bench, 0x60C2, 1), 1);
  EXPECT_EQ(entry(bench, 0x60C2, 2), -3) << "one millisecond";
  EXPECT_EQ(entry(bench, 0x1600, 1), 0x60400010);
  EXPECT_EQ(entry(bench, 0x1600, 2), 0x60710010);
  EXPECT_EQ(entry(bench, 0x1A00, 1), 0x60640020);
  EXPECT_EQ(entry(bench, 0x1A00, 2), 0x60410010);
  EXPECT_EQ(entry(bench, 0x1A00, 3), 0x60770010);
  EXPECT_EQ(entry(bench, 0x1A01, 1), 0x32010110) << "the temperature";
  EXPECT_EQ(entry(bench, 0x1802, 1) >> 31 & 1, 1) << "nobody wants TPDO3";
}

TEST(Cia402Setup, TellsWhatItFound) {
  DriveBench bench({bench_drive(3)});
  bench.start();
  const std::vector<std::string> messages = bench.bus().take_messages();
  ASSERT_EQ(messages.size(), 4U);
  expect_mentions(messages[3], {"joint3", "ms after its SYNC"});
  expect_mentions(messages[2], {"joint3: warning: rated_torque_unit", "maxon", "\"uNm\" is likely meant"});
  expect_mentions(messages[1], {"joint3", "node 3", "vendor 000000FBh", "mode 10 (CST)", "rated 9.6 N.m"});
  EXPECT_TRUE(bench.bus().take_messages().empty()) << "once";
}

TEST(Cia402Setup, FallsBackToTorqueProfileAndRefusesADriveWithout) {
  BenchDrive drive = bench_drive(3);
  drive.node.drive.has_cst = false;
  DriveBench fallback({drive});
  fallback.start();
  EXPECT_EQ(entry(fallback, 0x6060), 4);
  EXPECT_TRUE(fallback.enable());
  drive.node.drive.has_tq = false;
  expect_mentions(DriveBench({drive}).start_refusal(), {"node 3", "6502h", "mode 10", "mode 4"});
}

TEST(Cia402Setup, RefusesAnotherDriveThanTheConfigurationMeans) {
  BenchDrive drive = bench_drive(3);
  drive.config.identity.vendor_id = 0x0000009A;
  expect_mentions(DriveBench({drive}).start_refusal(),
                  {"vendor_id = 0000009Ah", "000000FBh", "not the drive of the configuration"});
  drive = bench_drive(3);
  drive.config.identity.serial_number = 7;
  expect_mentions(DriveBench({drive}).start_refusal(), {"serial_number = 00000007h", "00000001h"});
}

TEST(Cia402Setup, RefusesADeviceOfAnotherProfile) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("pretend 0x1000 0 0x00030191");
  expect_mentions(bench.start_refusal(), {"1000h = 00030191h", "0192h"});
}

TEST(Cia402Setup, RefusesTorqueInTheWrongUnit) {
  BenchDrive drive = bench_drive(3);
  drive.node.drive.rated_torque_units_per_Nm = 1e6;
  expect_mentions(DriveBench({drive}).start_refusal(),
                  {"6076h", "rated_torque_unit = \"uNm\"", "would agree"});
}

TEST(Cia402Setup, RefusesALimitThatTheTargetTorqueCannotHold) {
  BenchDrive drive = bench_drive(3);
  drive.config.torque_limit_Nm = 400.0;
  expect_mentions(DriveBench({drive}).start_refusal(),
                  {"torque_limit_Nm = 400", "32.767 times the rated 9.6", "6071h"});
}

TEST(Cia402Setup, RefusesADriveThatKeepsAnotherValueThanItWasGiven) {
  for (const char* lie : {"pretend 0x1016 1 0", "pretend 0x6007 0 0", "pretend 0x6072 0 999",
                          "pretend 0x1A00 1 0", "pretend 0x6061 0 8"}) {
    DriveBench bench({bench_drive(3)});
    bench.tell_node(lie);
    const std::string text = bench.start_refusal();
    EXPECT_NE(text.find(std::string(lie).substr(10, 4)), std::string::npos) << lie << ": " << text;
  }
}

TEST(Cia402Setup, GivesTheDrivesReasonForARefusedObject) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("refuse 0x1600 0 0x06020000");
  expect_mentions(bench.start_refusal(), {"1600h:00", "no such object", "06020000h"});
}

TEST(Cia402Setup, NamesEveryDriveThatFails) {
  BenchDrive absent = bench_drive(4);
  absent.config.node_id = 5;
  absent.config.boot_timeout_s = 0.2;
  BenchDrive wrong = bench_drive(3);
  wrong.config.identity.product_code = 1;
  expect_mentions(DriveBench({absent, wrong}).start_refusal(),
                  {"node 5", "no answer", "node 3", "product_code"});
}

bool is_order(const CanFrame& frame) {
  // The command specifier of the first frame of a download is 1.
  const bool writes = frame.id == 0x603 && frame.bytes[0] >> 5U == 1U;
  return frame.id == 0 || frame.id == 0x203 || writes;
}

TEST(Cia402Setup, LeavesADriveAloneThatItRefuses) {
  BenchDrive drive = bench_drive(3);
  drive.config.identity.vendor_id = 0x0000009A;
  DriveBench bench({drive});
  EXPECT_NE(bench.start_refusal(), "accepted");
  for (const VirtualCan::Entry& entry : bench.can().trace())
    EXPECT_TRUE(entry.from_node || !is_order(entry.frame)) << std::hex << entry.frame.id;
}

TEST(Cia402Setup, RefusesTwoNodesWithOneId) {
  DriveBench bench({bench_drive(3)});
  can_nodes::Cia402NodeConfig twin = bench_drive(3).node;
  twin.serial = 2;
  bench.can().add<can_nodes::Cia402Node>(twin);
  expect_mentions(bench.start_refusal(), {"node 3", "two nodes"});
}

TEST(Cia402Setup, ChangesTheIdentifierOfAPdoOnlyWhileItIsSwitchedOff) {
  DriveBench bench({bench_drive(3)});
  bench.can().run_to(bench.can().now_ns() + 200'000'000);
  // The value left by another master. A reset of the communication restores the stored value.
  can_nodes::Object identifier = *bench.node().dictionary().find({0x1800, 1});
  identifier.value = 0x1C5;
  bench.node().dictionary().add({0x1800, 1}, identifier);
  bench.start();
  EXPECT_EQ(entry(bench, 0x1800, 1) & 0x7FF, 0x183);
  EXPECT_TRUE(bench.enable());
}

TEST(Cia402Setup, TakesADriveWithoutOptionalObjectsAndSaysWhatItDoesWithout) {
  BenchDrive drive = bench_drive(3);
  drive.node.lacks = {0x6072, 0x60E0, 0x60E1, 0x607E, 0x60B2};
  DriveBench bench({drive});
  bench.start();
  std::string said;
  for (const std::string& line : bench.bus().take_messages()) said += line;
  expect_mentions(said, {"6072h, 60E0h and 60E1h", "only this daemon limits the torque"});
  EXPECT_TRUE(bench.enable());
}

TEST(Cia402Setup, LimitsTorqueByWhicheverObjectTheDriveHas) {
  BenchDrive drive = bench_drive(3);
  drive.node.lacks = {0x6072};
  DriveBench bench({drive});
  bench.start();
  EXPECT_EQ(entry(bench, 0x60E0), 2083);
  EXPECT_EQ(entry(bench, 0x60E1), 2083);
}

TEST(Cia402Setup, TakesAStoredTorqueOffsetAwayAndRefusesAStoredPolarity) {
  DriveBench offset({bench_drive(3)});
  offset.can().run_to(offset.can().now_ns() + 200'000'000);
  offset.node().dictionary().set({0x60B2, 0}, 100);
  offset.start();
  EXPECT_EQ(entry(offset, 0x60B2), 0);
  DriveBench polarity({bench_drive(3)});
  polarity.can().run_to(polarity.can().now_ns() + 200'000'000);
  polarity.node().dictionary().set({0x607E, 0}, 0x80);
  expect_mentions(polarity.start_refusal(), {"607Eh", "80h", "direction"});
}

TEST(Cia402Setup, LetsATorqueOfTheProfileModeChangeWithinAPeriod) {
  BenchDrive drive = bench_drive(3);
  drive.node.drive.has_cst = false;
  DriveBench bench({drive});
  bench.can().run_to(bench.can().now_ns() + 200'000'000);
  bench.node().dictionary().set({0x6087, 0}, 1000);
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(3, {10.0, true});
  EXPECT_NEAR(bench.node().drive().torque_demand_Nm(), 10.0, 0.01);
}

TEST(Cia402Setup, NamesTheObjectThatCannotBeMappedAndNotTheEntryThatMapsIt) {
  BenchDrive drive = bench_drive(3);
  drive.config.temperature->entry = {0x2FFF, 1};
  expect_mentions(DriveBench({drive}).start_refusal(), {"1A01h:01", "object 2FFFh:01"});
}

TEST(Cia402Setup, LeavesADisabledDriveWhateverItWasDoing) {
  DriveBench bench({bench_drive(3)});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(50, {10.0, true});
  bench.start();  // a second daemon; the bus of the first one ends without an order to the drive
  bench.run(5, {0.0, false});
  EXPECT_NE(bench.node().drive().power(), can_nodes::PowerState::kOperationEnabled);
  EXPECT_EQ(bench.node().drive().torque_demand_Nm(), 0.0);
  EXPECT_EQ(bench.reading().drive_state, DriveState::kDisabled);
}

TEST(Cia402Setup, ShowsAFaultThatTheDriveAlreadyHas) {
  DriveBench bench({bench_drive(3)});
  bench.can().run_to(bench.can().now_ns() + 200'000'000);
  bench.tell_node("emcy 0x4310");
  bench.can().run_to(bench.can().now_ns() + 200'000'000);
  bench.start();
  std::string said;
  for (const std::string& line : bench.bus().take_messages()) said += line;
  expect_mentions(said, {"in fault", "4310h", "clear-fault"});
  bench.run(5, {0.0, false});
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone) << "nobody uses it yet";
  EXPECT_EQ(bench.periods_until_fault(3, {0.0, true}), 2);
  EXPECT_EQ(bench.reading().drive_error & 0xFFFF, 0x4310U);
  bench.clear();
  EXPECT_TRUE(bench.enable());
}

TEST(Cia402Setup, MakesOneDriveTheSyncProducerWhenAsked) {
  BenchDrive drive = bench_drive(3);
  drive.config.produces_sync = true;
  drive.config.daemon_sends_sync = false;
  DriveBench bench({drive});
  bench.bus_config().sync = SyncProducer::kOther;
  // The simulated drive cannot produce SYNC. The test checks the order to do so.
  bench.tell_node("refuse 0x1005 0 0x06090030");
  expect_mentions(bench.start_refusal(), {"1005h:00", "value not allowed"});
  EXPECT_EQ(entry(bench, 0x1006), 1000);
}

}  // namespace
}  // namespace strainwave::testing
