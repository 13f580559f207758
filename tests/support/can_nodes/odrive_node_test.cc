// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/odrive_node.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "sim/joint/reference_plant.h"
#include "tests/support/can_nodes/node_bench.h"

namespace strainwave::can_nodes {
namespace {

OdriveNodeConfig node_config() {
  OdriveNodeConfig config;
  config.node_id = 2;
  config.plant = realistic_plant();
  config.plant.delay.periods = 0.0;
  config.encoder_us = 0;
  return config;
}

class OdriveNodeTest : public ::testing::Test {
 protected:
  static std::uint32_t id(unsigned command) { return 2U << 5 | command; }

  std::vector<Frame> ask(unsigned command) {
    Frame request;
    request.id = id(command);
    request.remote = true;
    return bench_.exchange(request);
  }
  void tell(unsigned command, std::uint64_t value, std::size_t size) {
    std::vector<std::uint8_t> bytes;
    append_little_endian(bytes, value, size);
    bench_.exchange({id(command), bytes});
  }
  void torque(float torque_Nm) { tell(0x0E, std::bit_cast<std::uint32_t>(torque_Nm), 4); }
  static double float_of(const Frame& frame, std::size_t offset) {
    return static_cast<double>(
        std::bit_cast<float>(static_cast<std::uint32_t>(little_endian(frame.bytes().subspan(offset, 4)))));
  }
  void run(float torque_Nm, int periods) {
    for (int i = 0; i < periods; ++i) {
      torque(torque_Nm);
      bench_.wait_us(1000);
    }
  }
  void arm() {
    bench_.wait_us(60000);
    tell(0x0B, 1 | std::uint64_t{1} << 32, 8);
    tell(0x07, 8, 4);
    run(0.0F, 10);
    ASSERT_EQ(bench_.node.state(), OdriveState::kClosedLoop);
  }

  NodeBench<OdriveNode, OdriveNodeConfig> bench_{node_config()};
};

TEST_F(OdriveNodeTest, TellsItsVersionOnRequest) {
  EXPECT_TRUE(ask(0x00).empty());  // still booting
  bench_.wait_us(60000);
  const auto answers = ask(0x00);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0], Frame(id(0x00), {2, 4, 4, 58, 0, 6, 10, 0}));
  bench_.command("firmware 0 5 6");
  EXPECT_EQ(ask(0x00)[0].data[5], 5);
}

TEST_F(OdriveNodeTest, TurnsTheJointByTorqueInTorqueMode) {
  arm();
  run(0.3F, 20);
  EXPECT_NEAR(bench_.node.torque_Nm(), 15.0, 1e-6);  // ratio 50
  const double joint_rad = bench_.node.plant().state().position_rad;
  EXPECT_GT(joint_rad, 0.0);
  EXPECT_NEAR(float_of(ask(0x09)[0], 0), joint_rad / (2.0 * M_PI) * 50.0, 0.5 * 50.0 / 320000.0 + 1e-6);
}

TEST_F(OdriveNodeTest, ClosesItsOwnLoopsOfPositionAndVelocity) {
  arm();
  tell(0x0B, 3 | std::uint64_t{1} << 32, 8);
  // 2 turns of the motor.
  for (int i = 0; i < 1000; ++i) {
    tell(0x0C, std::bit_cast<std::uint32_t>(2.0F), 8);
    bench_.wait_us(1000);
  }
  EXPECT_NEAR(bench_.node.plant().state().position_rad, 2.0 * 2.0 * M_PI / 50.0, 1e-4);
  EXPECT_NEAR(float_of(ask(0x1C)[0], 4) * 50.0, bench_.node.torque_Nm(), 1e-3);
  tell(0x0B, 2 | std::uint64_t{1} << 32, 8);
  for (int i = 0; i < 300; ++i) {
    tell(0x0D, std::bit_cast<std::uint32_t>(-8.0F), 8);
    bench_.wait_us(1000);
  }
  EXPECT_NEAR(bench_.node.plant().state().velocity_rad_s, -8.0 * 2.0 * M_PI / 50.0, 0.01);
}

TEST_F(OdriveNodeTest, DisarmsWhenItsWatchdogIsNotFed) {
  arm();
  run(0.3F, 100);
  EXPECT_EQ(bench_.node.state(), OdriveState::kClosedLoop);
  bench_.wait_us(98000);
  EXPECT_EQ(bench_.node.state(), OdriveState::kClosedLoop);
  bench_.wait_us(2000);
  EXPECT_EQ(bench_.node.state(), OdriveState::kIdle);
  EXPECT_EQ(bench_.node.errors(), kOdriveWatchdogExpired);
  EXPECT_EQ(ask(0x03)[0], Frame(id(0x03), {0, 0, 0, 1, 0, 0, 0, 1}));
  bench_.wait_us(2000000);
  EXPECT_TRUE(bench_.recorded("at-rest"));
}

TEST_F(OdriveNodeTest, ArmsOnlyWithoutErrors) {
  arm();
  tell(0x02, 0, 0);
  EXPECT_EQ(bench_.node.errors(), kOdriveEstopRequested);
  tell(0x07, 8, 4);
  run(0.0F, 10);
  EXPECT_EQ(bench_.node.state(), OdriveState::kIdle);
  tell(0x18, 0, 1);
  tell(0x07, 8, 4);
  run(0.0F, 10);
  EXPECT_EQ(bench_.node.state(), OdriveState::kClosedLoop);
}

TEST_F(OdriveNodeTest, IgnoresATorqueThatIsNoNumberAndAShortFrame) {
  arm();
  run(0.1F, 2);
  torque(std::numeric_limits<float>::quiet_NaN());
  tell(0x0E, 0, 3);
  bench_.wait_us(1000);
  EXPECT_NEAR(bench_.node.torque_Nm(), 5.0, 1e-6);
}

TEST_F(OdriveNodeTest, SendsHeartbeatsWithStateAndErrors) {
  arm();
  bench_.command("error 0x2000");
  bench_.output.frames.clear();
  bench_.wait_us(100000);
  EXPECT_TRUE(bench_.sent({id(0x01), {0x00, 0x20, 0, 0, 1, 3, 0, 0}}));
}

TEST_F(OdriveNodeTest, ReadsAndWritesItsWatchdogByEndpoint) {
  bench_.wait_us(60000);
  EXPECT_EQ(bench_.exchange({id(0x04), {0, 190, 0, 0}}).at(0), Frame(id(0x05), {0, 190, 0, 0, 1}));
  tell(0x04, 0x0000BE01, 5);  // write endpoint 190: off
  EXPECT_EQ(bench_.exchange({id(0x04), {0, 190, 0, 0}}).at(0).data[4], 0);
  EXPECT_TRUE(bench_.exchange({id(0x04), {0, 1, 0, 0}}).empty());
}

TEST_F(OdriveNodeTest, MisbehavesAsItIsTold) {
  arm();
  bench_.command("skip-encoder 1");
  EXPECT_TRUE(ask(0x09).empty());
  EXPECT_EQ(ask(0x09).size(), 1U);
  bench_.command("bad-encoder on");
  EXPECT_TRUE(std::isnan(float_of(ask(0x09)[0], 0)));
  bench_.command("bus 5");
  run(0.0F, 2);
  EXPECT_EQ(bench_.node.errors(), kOdriveUnderVoltage);
  bench_.command("cut");
  EXPECT_TRUE(ask(0x09).empty());
  EXPECT_NE(bench_.command("bus"), "");
  EXPECT_NE(bench_.command("error twice"), "");
}

}  // namespace
}  // namespace strainwave::can_nodes
