// SPDX-License-Identifier: BSD-3-Clause
// Homing of a simulated joint by the real daemon, ordered over LCM.
#include <cmath>
#include <optional>

#include "tests/support/daemon_fixture.h"
#include "tests/support/private_network.h"

namespace strainwave::testing {
namespace {

class DaemonHoming : public DaemonTest {};

TEST_F(DaemonHoming, MustComeFirstAndMakesPositionsTrue) {
  // The joint is at 0.4, where its encoder begins to count. The home switch is from 0.2 to 0.25.
  DaemonProcess daemon(folder_,
                       configuration("[joint.homing]\nto = \"home\"\nrequired = true\nposition_rad = 0.25\n"
                                     "speed_rad_s = 0.1\n"
                                     "[joint.simulated]\ninitial_position_rad = 0.4\nincremental = true\n"
                                     "home_from_rad = 0.2\nhome_to_rad = 0.25\n"));
  TestClient client;
  ASSERT_TRUE(client.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon.log();
  EXPECT_EQ(client.state("elbow")->notices & static_cast<int>(Notice::kNotHomed),
            static_cast<int>(Notice::kNotHomed));
  ASSERT_TRUE(client.load("elbow", shipped_table()).accepted);
  ASSERT_TRUE(client.command("elbow", Action::kEnable).accepted);
  ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kHolding)) << daemon.log();
  const Answer refused = client.move("elbow", 0.3);
  EXPECT_EQ(refused.reason, Reason::kNotHomed);
  EXPECT_NE(refused.text.find("home it first"), std::string::npos) << refused.text;

  ASSERT_TRUE(client.command("elbow", Action::kHome).accepted);
  ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kHoming)) << daemon.log();
  ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kHolding, std::chrono::seconds(30))) << daemon.log();
  EXPECT_EQ(client.state("elbow")->notices & static_cast<int>(Notice::kNotHomed), 0);
  // It rests a little above the edge, which it left upwards.
  EXPECT_NEAR(client.state("elbow")->joint_position_rad, 0.25, 0.01);
  EXPECT_TRUE(client.move("elbow", 0.3).accepted);
}

TEST_F(DaemonHoming, IsRefusedWhereTheConfigurationNamesNothingToFind) {
  DaemonProcess daemon(folder_, configuration());
  TestClient client;
  ASSERT_TRUE(client.wait_for_state("elbow", [](const state_v1&) { return true; })) << daemon.log();
  ASSERT_TRUE(client.load("elbow", shipped_table()).accepted);
  ASSERT_TRUE(client.command("elbow", Action::kEnable).accepted);
  ASSERT_TRUE(client.wait_for_mode("elbow", Mode::kHolding)) << daemon.log();
  const Answer refused = client.command("elbow", Action::kHome);
  EXPECT_EQ(refused.reason, Reason::kNoHoming);
  EXPECT_NE(refused.text.find("joint.homing"), std::string::npos) << refused.text;
}

}  // namespace
}  // namespace strainwave::testing
