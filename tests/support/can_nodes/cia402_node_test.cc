// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/cia402_node.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/joint/reference_plant.h"
#include "tests/support/can_nodes/node_bench.h"

namespace strainwave::can_nodes {
namespace {

constexpr std::uint8_t kMaster = 127;

Cia402NodeConfig node_config() {
  Cia402NodeConfig config;
  config.node_id = 3;
  config.drive.plant = realistic_plant();
  config.drive.plant.delay.periods = 0.0;
  return config;
}

class Cia402NodeTest : public ::testing::Test {
 protected:
  using Bench = NodeBench<Cia402Node, Cia402NodeConfig>;

  void write(std::uint16_t index, std::uint8_t sub, std::int64_t value, std::size_t size,
             bool accepted = true) {
    std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(0x23 | ((4 - size) << 2))};
    append_little_endian(bytes, index, 2);
    bytes.push_back(sub);
    append_little_endian(bytes, static_cast<std::uint64_t>(value) & 0xFFFFFFFF, 4);
    const std::vector<Frame> answers = bench_.exchange({0x603, bytes});
    ASSERT_EQ(answers.size(), 1U);
    EXPECT_EQ(answers[0].data[0], accepted ? 0x60 : 0x80) << std::hex << index;
  }
  std::int64_t read(std::uint16_t index, std::uint8_t sub = 0) {
    std::vector<std::uint8_t> bytes{0x40};
    append_little_endian(bytes, index, 2);
    append_little_endian(bytes, sub, 5);
    const std::vector<Frame> answers = bench_.exchange({0x603, bytes});
    return answers.size() == 1 && answers[0].data[0] != 0x80
               ? static_cast<std::int64_t>(little_endian(answers[0].bytes().subspan(4)))
               : -1;
  }
  void boot() { bench_.wait_us(60000); }
  void nmt(std::uint8_t order) { bench_.exchange({0x000, {order, 3}}); }
  /// Sends an RPDO with controlword and torque, then SYNC, and waits a period. Returns the answers to the SYNC.
  std::vector<Frame> cycle(std::uint16_t controlword, std::int16_t torque_permille, bool heartbeat = true) {
    std::vector<std::uint8_t> bytes;
    append_little_endian(bytes, controlword, 2);
    append_little_endian(bytes, static_cast<std::uint16_t>(torque_permille), 2);
    bench_.exchange({0x203, bytes});
    if (heartbeat) bench_.exchange({0x700U + kMaster, {0x05}});
    std::vector<Frame> frames = bench_.exchange({0x080, {}});
    bench_.wait_us(1000);
    return frames;
  }
  void configure(std::int64_t abort_option, std::int64_t mode = 10) {
    boot();
    write(0x1400, 1, 0x80000203, 4);
    write(0x1600, 0, 0, 1);
    write(0x1600, 1, 0x60400010, 4);
    write(0x1600, 2, 0x60710010, 4);
    write(0x1600, 0, 2, 1);
    write(0x1400, 2, 1, 1);
    write(0x1400, 1, 0x203, 4);
    write(0x1800, 2, 1, 1);
    write(0x1016, 1, (kMaster << 16) | 20, 4);
    write(0x6007, 0, abort_option, 2);
    write(0x6060, 0, mode, 1);
    nmt(0x01);
  }
  void enable() {
    for (int i = 0; i < 5; ++i) cycle(0x06, 0);
    for (int i = 0; i < 5; ++i) cycle(0x07, 0);
    for (int i = 0; i < 30; ++i) cycle(0x0F, 0);
    ASSERT_EQ(bench_.node.drive().power(), PowerState::kOperationEnabled);
  }

  Bench bench_{node_config()};
};

TEST_F(Cia402NodeTest, BootsUpOnceAndAnswersOnlyThen) {
  EXPECT_EQ(read(0x1000), -1);
  boot();
  EXPECT_EQ(read(0x1000), 0x00020192);
  EXPECT_EQ(bench_.node.nmt(), NmtState::kPreOperational);
  bench_.output.frames.clear();
  nmt(0x82);
  bench_.wait_us(60000);
  EXPECT_TRUE(bench_.sent({0x703, {0}}));
}

TEST_F(Cia402NodeTest, GoesThroughTheProfilesStatesAndDelaysEnabling) {
  configure(1);
  EXPECT_EQ(read(0x6041) & 0x6F, 0x40);
  cycle(0x07, 0);  // not possible in this state
  EXPECT_EQ(read(0x6041) & 0x4F, 0x40);
  cycle(0x06, 0);
  EXPECT_EQ(read(0x6041) & 0x6F, 0x21);
  cycle(0x07, 0);
  EXPECT_EQ(read(0x6041) & 0x6F, 0x23);
  cycle(0x0F, 0);
  EXPECT_EQ(read(0x6041) & 0x6F, 0x23);
  for (int i = 0; i < 10; ++i) cycle(0x0F, 0);
  EXPECT_EQ(read(0x6041) & 0x6F, 0x27);
  EXPECT_EQ(read(0x6061), 10);
}

TEST_F(Cia402NodeTest, TurnsTheJointByPermilleOfItsRatedTorque) {
  configure(1);
  enable();
  // 0.192 N m at the motor, ratio 50: 1000 per mille are 9.6 N m at the joint.
  for (int i = 0; i < 20; ++i) cycle(0x0F, 900);
  EXPECT_NEAR(bench_.node.drive().torque_demand_Nm(), 8.64, 1e-9);
  EXPECT_NEAR(static_cast<double>(read(0x6077)), 900.0, 1.0);
  const JointState& joint = bench_.node.drive().plant().state();
  EXPECT_GT(joint.position_rad, 0.0);
  const double counts = joint.position_rad / (2.0 * M_PI) * 320000.0;
  EXPECT_NEAR(static_cast<double>(static_cast<std::int32_t>(read(0x6064))), counts, 0.5 + 1e-6);
}

TEST_F(Cia402NodeTest, LimitsTheTorqueAndSaysSo) {
  configure(1);
  write(0x6072, 0, 300, 2);
  enable();
  cycle(0x0F, 900);
  EXPECT_NEAR(bench_.node.drive().torque_demand_Nm(), 2.88, 1e-9);
  EXPECT_NE(read(0x6041) & (1 << 11), 0);
}

TEST_F(Cia402NodeTest, RampsInProfileTorqueMode) {
  configure(1, 4);
  write(0x6087, 0, 10000, 4);  // per mille per second: 10 per period
  enable();
  cycle(0x0F, 500);
  EXPECT_NEAR(bench_.node.drive().torque_demand_Nm(), 0.096, 1e-9);
  for (int i = 0; i < 60; ++i) cycle(0x0F, 500);
  EXPECT_NEAR(bench_.node.drive().torque_demand_Nm(), 4.8, 1e-9);
}

struct LossCase {
  std::int64_t option;
  PowerState during;
  PowerState end;
};

class LostMaster : public Cia402NodeTest, public ::testing::WithParamInterface<LossCase> {};

TEST_P(LostMaster, IsAnsweredAsObject6007hSays) {
  configure(GetParam().option);
  enable();
  for (int i = 0; i < 100; ++i) cycle(0x0F, 900);
  ASSERT_GT(bench_.node.drive().plant().state().velocity_rad_s, 0.5);
  bench_.output.frames.clear();
  bench_.wait_us(19500);  // the last heartbeat was 1 ms ago
  EXPECT_TRUE(bench_.recorded("heartbeat-lost node=127"));
  EXPECT_EQ(bench_.node.drive().power(), GetParam().during);
  EXPECT_TRUE(bench_.sent({0x083, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}}));
  EXPECT_EQ(bench_.node.nmt(), NmtState::kPreOperational);
  bench_.wait_us(2000000);
  EXPECT_EQ(bench_.node.drive().power(), GetParam().end);
  if (GetParam().option != 0) {
    EXPECT_TRUE(bench_.node.drive().plant().state().stuck);
    EXPECT_EQ(bench_.node.drive().torque_demand_Nm(), 0.0);
    EXPECT_TRUE(bench_.recorded("at-rest"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Options, LostMaster,
    ::testing::Values(LossCase{0, PowerState::kOperationEnabled, PowerState::kOperationEnabled},
                      LossCase{1, PowerState::kFaultReactionActive, PowerState::kFault},
                      LossCase{2, PowerState::kSwitchOnDisabled, PowerState::kSwitchOnDisabled},
                      LossCase{3, PowerState::kQuickStopActive, PowerState::kSwitchOnDisabled}));

TEST_F(Cia402NodeTest, KeepsRunningWhileTheHeartbeatLives) {
  configure(1);
  enable();
  for (int i = 0; i < 200; ++i) cycle(0x0F, 0);
  EXPECT_FALSE(bench_.recorded("heartbeat-lost"));
}

TEST_F(Cia402NodeTest, FaultsWithAnEmcyAndIsResetByARisingEdge) {
  configure(1);
  enable();
  bench_.output.frames.clear();
  EXPECT_EQ(bench_.command("emcy 0x4210"), "");
  EXPECT_TRUE(bench_.sent({0x083, {0x10, 0x42, 0x09, 0, 0, 0, 0, 0}}));
  EXPECT_EQ(read(0x603F), 0x4210);
  EXPECT_EQ(read(0x1003, 1), 0x4210);
  for (int i = 0; i < 5; ++i) cycle(0x0F, 0);
  EXPECT_EQ(read(0x6041) & 0x4F, 0x08);
  cycle(0x80, 0);
  EXPECT_EQ(read(0x6041) & 0x4F, 0x40);
  EXPECT_EQ(read(0x1001), 0);
  bench_.command("emcy 0x2310");
  for (int i = 0; i < 5; ++i) cycle(0x80, 0);  // no edge: bit 7 was already set
  EXPECT_EQ(read(0x6041) & 0x4F, 0x08);
}

TEST_F(Cia402NodeTest, GoesOnAloneWhenTheCableIsCut) {
  configure(1);
  enable();
  for (int i = 0; i < 100; ++i) cycle(0x0F, 900);
  bench_.command("cut");
  EXPECT_TRUE(cycle(0x0F, 900).empty());
  for (int i = 0; i < 30; ++i) cycle(0x0F, 900);
  EXPECT_TRUE(bench_.recorded("heartbeat-lost"));
  bench_.command("reconnect");
  EXPECT_NE(read(0x1000), -1);
}

TEST_F(Cia402NodeTest, LosesItsSettingsWhenItReboots) {
  configure(3);
  enable();
  bench_.output.frames.clear();
  bench_.command("reboot 100");
  bench_.wait_us(99000);
  EXPECT_TRUE(bench_.output.frames.empty());
  bench_.wait_us(2000);
  EXPECT_TRUE(bench_.sent({0x703, {0}}));
  EXPECT_EQ(read(0x6007), 1);
  EXPECT_EQ(read(0x1016, 1), 0);
  EXPECT_EQ(bench_.node.drive().power(), PowerState::kSwitchOnDisabled);
}

TEST_F(Cia402NodeTest, MisbehavesAsItIsTold) {
  configure(1);
  EXPECT_EQ(cycle(0x06, 0).size(), 1U);
  bench_.command("skip-tpdo 2");
  EXPECT_EQ(cycle(0x06, 0).size() + cycle(0x06, 0).size(), 0U);
  EXPECT_EQ(cycle(0x06, 0).size(), 1U);
  bench_.command("late-tpdo 300 1");
  EXPECT_TRUE(bench_.exchange({0x080, {}}).empty());
  bench_.output.frames.clear();
  bench_.wait_us(299);
  EXPECT_TRUE(bench_.output.frames.empty());
  bench_.wait_us(1);
  EXPECT_EQ(bench_.output.frames.size(), 1U);
  bench_.command("pretend 0x6061 0 8");
  EXPECT_EQ(read(0x6061), 8);
  bench_.command("pretend 0x1018 1 0x99");
  EXPECT_EQ(read(0x1018, 1), 0x99);
  bench_.command("pretend nothing");
  EXPECT_EQ(read(0x1018, 1), 0xFB);
  EXPECT_EQ(bench_.command("pretend 0x2FFF 0 1"), "no such object");
  EXPECT_NE(bench_.command("cut it"), "");
  EXPECT_NE(bench_.command("emcy"), "");
  EXPECT_NE(bench_.command("jump"), "");
}

TEST_F(Cia402NodeTest, ProducesItsHeartbeatOnlyWhenToldTo) {
  boot();
  bench_.output.frames.clear();
  bench_.wait_us(100000);
  EXPECT_TRUE(bench_.output.frames.empty());
  write(0x1017, 0, 10, 2);
  bench_.wait_us(100000);
  EXPECT_NEAR(static_cast<double>(
                  std::count(bench_.output.frames.begin(), bench_.output.frames.end(), Frame(0x703, {0x7F}))),
              10.0, 1.0);
  bench_.command("heartbeat off");
  bench_.output.frames.clear();
  bench_.wait_us(100000);
  EXPECT_TRUE(bench_.output.frames.empty());
}

TEST_F(Cia402NodeTest, ShowsItsRatedTorqueInTheUnitThatItHas) {
  boot();
  EXPECT_EQ(read(0x6076), 192);
  Cia402NodeConfig micro = node_config();
  micro.drive.rated_torque_units_per_Nm = 1e6;
  Bench other(micro);
  EXPECT_EQ(other.node.dictionary().number({0x6076, 0}), 192000);
}

TEST_F(Cia402NodeTest, RefusesModesThatItHasNot) {
  boot();
  write(0x6060, 0, 8, 1, false);
  EXPECT_EQ(read(0x6502), (1 << 9) | (1 << 3));
}

}  // namespace
}  // namespace strainwave::can_nodes
