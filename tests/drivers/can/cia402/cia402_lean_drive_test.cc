// SPDX-License-Identifier: BSD-3-Clause
// Drives that lack common objects or have them fixed. The driver accepts them if nothing is lost, and reports what is missing.
#include <gtest/gtest.h>

#include "tests/drivers/can/drive_bench.h"

namespace strainwave::testing {
namespace {

constexpr std::int64_t kBooted_ns = 200'000'000;
const char* const kNoObject = " 0x06020000";

class Cia402LeanDrive : public ::testing::Test {
 protected:
  /// Changes the stored value, which a reset of the communication restores.
  static void store(DriveBench& bench, can_nodes::Key key, std::int64_t value, can_nodes::Access access) {
    can_nodes::Object object = *bench.node().dictionary().find(key);
    object.value = value;
    object.access = access;
    bench.node().dictionary().add(key, object);
  }
  static void fix_mapping(DriveBench& bench, std::uint16_t index, std::vector<std::int64_t> objects) {
    store(bench, {index, 0}, static_cast<std::int64_t>(objects.size()), can_nodes::Access::kReadOnly);
    for (std::size_t i = 0; i < objects.size(); ++i)
      store(bench, {index, static_cast<std::uint8_t>(i + 1)}, objects[i], can_nodes::Access::kReadOnly);
  }
};

TEST_F(Cia402LeanDrive, Without6502hIsAskedForEachModeByTrying) {
  for (const bool has_cst : {true, false}) {
    BenchDrive drive = bench_drive(3);
    drive.node.lacks = {0x6502};
    drive.node.drive.has_cst = has_cst;
    DriveBench bench({drive});
    bench.start();
    expect_mentions(bench.said(), {has_cst ? "mode 10 (CST)" : "mode 4 (TQ)"});
    EXPECT_TRUE(bench.enable());
  }
  BenchDrive neither = bench_drive(3);
  neither.node.lacks = {0x6502};
  neither.node.drive.has_cst = neither.node.drive.has_tq = false;
  expect_mentions(DriveBench({neither}).start_refusal(), {"has no 6502h", "mode 10", "mode 4", "6060h:00"});
}

TEST_F(Cia402LeanDrive, Without1016hNeedsTheDeadlineOfItsRpdo) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("refuse 0x1016 1" + std::string(kNoObject));
  bench.start();
  expect_mentions(bench.said(), {"not take 1016h", "only by the deadline of RPDO1"});
  EXPECT_TRUE(bench.enable());
  bench.end();
  EXPECT_EQ(bench.node().drive().power(), can_nodes::PowerState::kSwitchOnDisabled);

  DriveBench neither({bench_drive(3)});
  neither.tell_node("refuse 0x1016 1" + std::string(kNoObject));
  neither.tell_node("refuse 0x1400 5" + std::string(kNoObject));
  expect_mentions(neither.start_refusal(), {"takes neither 1016h", "nor 1400h:05", "nothing would stop it"});
}

TEST_F(Cia402LeanDrive, WithAHeartbeatOfItsOwnIsTakenWhenThatIsAsWanted) {
  for (const std::int64_t period_ms : {50, 200}) {
    DriveBench bench({bench_drive(3)});
    bench.can().run_to(kBooted_ns);
    store(bench, {0x1017, 0}, period_ms, can_nodes::Access::kReadOnly);
    expect_mentions(bench.start_refusal(), {period_ms == 50 ? "accepted" : "(1017h): set drive_heartbeat_s"});
  }
}

TEST_F(Cia402LeanDrive, Without6007hSaysWhatIsToBeTried) {
  DriveBench bench({bench_drive(3)});
  bench.tell_node("refuse 0x6007 0" + std::string(kNoObject));
  bench.start();
  expect_mentions(bench.said(), {"not take 6007h", "kill the daemon", "check that it stops"});
  EXPECT_TRUE(bench.enable());
}

TEST_F(Cia402LeanDrive, WithAFixedMappingIsTakenWhenThatIsAsWanted) {
  DriveBench bench({bench_drive(3)});
  bench.can().run_to(kBooted_ns);
  fix_mapping(bench, 0x1600, {0x60400010, 0x60710010});
  fix_mapping(bench, 0x1A00, {0x60640020, 0x60410010, 0x60770010});
  bench.start();
  ASSERT_TRUE(bench.enable());
  bench.run(20, {5.0, true});
  EXPECT_NEAR(bench.node().drive().torque_demand_Nm(), 5.0, 0.01);

  DriveBench other({bench_drive(3)});
  other.can().run_to(kBooted_ns);
  fix_mapping(other, 0x1600, {0x60710010, 0x60400010});
  expect_mentions(other.start_refusal(), {"1600h:00", "read-only", "RPDO1 emptied"});
}

TEST_F(Cia402LeanDrive, ThatCannotMap6061hIsAskedForItsModeBySdo) {
  DriveBench bench({bench_drive(3)});
  bench.can().run_to(kBooted_ns);
  can_nodes::Object mode = *bench.node().dictionary().find({0x6061, 0});
  mode.mappable = can_nodes::Mappable::kNo;
  bench.node().dictionary().add({0x6061, 0}, mode);
  bench.start();
  expect_mentions(bench.said(), {"6061h", "reads its mode by SDO"});
  ASSERT_TRUE(bench.enable());
  bench.bus().serve();
  bench.run(20, {1.0, true});
  EXPECT_TRUE(bench.reading().has_temperature) << "the rest of TPDO2 comes";
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone);
  bench.tell_node("pretend 0x6061 0 8");
  bench.run(1100, {1.0, true});
  EXPECT_EQ(bench.reading().fault, ActuatorFault::kNone) << "nobody has asked yet";
  bench.bus().serve();
  EXPECT_GT(bench.periods_until_fault(3, {1.0, true}), 0);
  EXPECT_EQ(detail_of(bench.reading().drive_error), CanDetail::kWrongMode);
}

TEST_F(Cia402LeanDrive, ThatLetsAnEntryOnlyBeReadIsTakenWhereItsValueDoesNoHarm) {
  using can_nodes::Access;
  BenchDrive drive = bench_drive(3);
  drive.config.drive_mode = DriveMode::kPosition;
  drive.node.drive.has_csp = true;
  drive.node.read_only = {{0x605A, 0}, {0x60B1, 0}, {0x60B2, 0}, {0x6007, 0}, {0x1006, 0}, {0x60E0, 0}};
  DriveBench bench({drive});
  store(bench, {0x6007, 0}, 3, Access::kReadOnly);
  bench.start();
  for (const char* line : {"605Ah", "6007h"}) EXPECT_EQ(bench.said().find(line), std::string::npos) << line;

  DriveBench other({drive});
  store(other, {0x605A, 0}, 6, Access::kReadOnly);
  other.start();
  expect_mentions(other.said(), {"not take 605Ah", "decides by itself how it stops", "not take 6007h"});

  DriveBench offset({drive});
  store(offset, {0x60B2, 0}, 20, Access::kReadOnly);
  expect_mentions(offset.start_refusal(), {"60B2h", "read-only and not 0", "added to each order"});
}

TEST_F(Cia402LeanDrive, WhosePdosHaveTheirIdentifiersForGoodIsLeftWithEmptyOnes) {
  using can_nodes::Access;
  const auto fix_identifiers = [](DriveBench& bench) {
    for (const std::int64_t pdo : {0, 1, 2, 3}) {
      const auto number = static_cast<std::uint16_t>(pdo);
      store(bench, {static_cast<std::uint16_t>(0x1400 + number), 1}, 0x203 + 0x100 * pdo, Access::kReadOnly);
      store(bench, {static_cast<std::uint16_t>(0x1800 + number), 1}, 0x183 + 0x100 * pdo, Access::kReadOnly);
    }
    store(bench, {0x1602, 1}, 0x60400010, Access::kReadWrite);
    store(bench, {0x1602, 0}, 1, Access::kReadWrite);
  };
  DriveBench bench({bench_drive(3)});
  fix_identifiers(bench);
  bench.start();
  EXPECT_EQ(bench.node().dictionary().number({0x1602, 0}), 0) << "a stranger could order by it";
  ASSERT_TRUE(bench.enable());
  bench.run(20, {5.0, true});
  EXPECT_NEAR(bench.node().drive().torque_demand_Nm(), 5.0, 0.01);

  DriveBench fixed({bench_drive(3)});
  fix_identifiers(fixed);
  store(fixed, {0x1602, 0}, 1, Access::kReadOnly);
  expect_mentions(fixed.start_refusal(), {"1602h:00", "read-only", "RPDO3 off"});
}

TEST_F(Cia402LeanDrive, WithNothingElseForTpdo2SendsNone) {
  BenchDrive drive = bench_drive(3);
  drive.config.temperature.reset();
  DriveBench bench({drive});
  bench.can().run_to(kBooted_ns);
  can_nodes::Object mode = *bench.node().dictionary().find({0x6061, 0});
  mode.mappable = can_nodes::Mappable::kNo;
  bench.node().dictionary().add({0x6061, 0}, mode);
  bench.start();
  EXPECT_TRUE(bench.enable());
  EXPECT_EQ(bench.node().dictionary().number({0x1801, 1}) >> 31 & 1, 1);
}

}  // namespace
}  // namespace strainwave::testing
