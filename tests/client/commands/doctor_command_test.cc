// SPDX-License-Identifier: BSD-3-Clause
// The doctor command on recordings, and the recordings that it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/client/commands/commands_fixture.h"
#include "tests/support/event_log_file.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

using testing::CommandsTest;

class DoctorTest : public CommandsTest {
 protected:
  /// Strokes of a joint of 0.2 kg m2 with friction. `sign` scales the recorded torque; -1 makes it wrong.
  void write_log(double sign, std::int32_t notices = 0) {
    testing::EventLogFile log(log_file());
    limits_v1 limits{};
    limits.period_s = 0.001;
    limits.inertia_kgm2 = 0.2;
    limits.torque_limit_Nm = 30.0;
    log.add(1, "SW.elbow.LIMITS", limits);
    for (std::int64_t cycle = 0; cycle < 6000; ++cycle) {
      const double t = 0.001 * static_cast<double>(cycle);
      const double later = t + 0.0015;
      state_v1 state{};
      state.cycle = cycle;
      state.utime = 1'000'000 + 1000 * cycle;
      state.mode = static_cast<std::int32_t>(Mode::kTracking);
      state.notices = notices;
      state.joint_position_rad = 0.5 * std::sin(3.0 * t);
      state.torque_commanded_Nm = state.torque_applied_Nm =
          sign * (-0.2 * 4.5 * std::sin(3.0 * later) + std::copysign(1.0, std::cos(3.0 * later)));
      state.link_position_rad = std::nan("");
      log.add(1000 * cycle, "SW.elbow.STATE", state);
    }
  }
  std::filesystem::path log_file() const { return folder_.path() / "a.lcm"; }
  DoctorArguments arguments() const {
    DoctorArguments arguments;
    arguments.joint = "elbow";
    arguments.log = log_file();
    return arguments;
  }

  TemporaryFolder folder_;
};

TEST_F(DoctorTest, FindsNothingInARecordingOfAHealthyJoint) {
  write_log(1.0);
  examine_log(output, arguments());
  EXPECT_TRUE(output_has("nothing found")) << stream.str();
  EXPECT_TRUE(output_has("--config")) << "what was not judged: " << stream.str();
}

TEST_F(DoctorTest, NamesAWrongSignWithEvidenceAndRemedyAndEndsWithOne) {
  write_log(-1.0);
  try {
    examine_log(output, arguments());
    ADD_FAILURE() << stream.str();
  } catch (const ClientError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kRefused);
  }
  for (const char* part : {"wrong sign", "seen: ", "kg m2", "do: "})
    EXPECT_TRUE(output_has(part)) << stream.str();
}

TEST_F(DoctorTest, WritesOneObjectForScripts) {
  write_log(1.0, static_cast<std::int32_t>(Notice::kReadingMissed));
  output.json = true;
  EXPECT_THROW(examine_log(output, arguments()), ClientError);
  const auto json = nlohmann::json::parse(stream.str());
  EXPECT_EQ(json.at("joint"), "elbow");
  EXPECT_EQ(json.at("findings").at(0).at("cause"), "bus overloaded");
  EXPECT_GT(json.at("findings").at(0).at("probability"), 0.5);
  EXPECT_FALSE(json.at("findings").at(0).at("evidence").empty());
}

TEST_F(DoctorTest, RefusesALogOfOtherJoints) {
  write_log(1.0);
  DoctorArguments other = arguments();
  other.joint = "wrist";
  EXPECT_THROW(examine_log(output, other), ClientError);
  other.joint = "";
  EXPECT_THROW(examine_log(output, other), ClientError);
}

TEST_F(DoctorTest, MovesNoJointThatDoesNotHold) {
  daemon.publish_state(Mode::kOff);
  DoctorArguments live;
  live.joint = "elbow";
  EXPECT_EQ(status_of([&] { examine_joint(client, output, live); }), ExitStatus::kRefused);
  EXPECT_TRUE(message_has("not holding")) << message;
}

}  // namespace
}  // namespace strainwave
