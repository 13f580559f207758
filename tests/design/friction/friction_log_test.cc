// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>

#include "strainwave/vocabulary.h"
#include "tests/support/event_log_file.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class FrictionLogTest : public ::testing::Test {
 protected:
  static limits_v1 limits() {
    limits_v1 message{};
    message.session_id = 7;
    message.period_s = 0.001;
    message.inertia_kgm2 = 0.089;
    message.gear_ratio = 50.0;
    std::memcpy(message.joint_model, "rhs17-6006", 10);
    return message;
  }
  static state_v1 state(std::int64_t cycle) {
    state_v1 message{};
    message.session_id = 7;
    message.cycle = cycle;
    message.mode = static_cast<std::int32_t>(Mode::kTracking);
    message.torque_applied_Nm = 0.25 * static_cast<double>(cycle);
    message.temperature_used_C = 21.0;
    return message;
  }
  std::string refusal(const std::string& joint = "") const {
    return testing::refusal_of([&] { read_friction_log(path_, joint); });
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.lcm";
  testing::EventLogFile log_{path_};
};

TEST_F(FrictionLogTest, ReadsTheMotionAndWhoseItIs) {
  log_.add(0, "SW.elbow.LIMITS", limits());
  log_.add(1, "SW.elbow.STATE", state(5));
  state_v1 blind = state(10);
  blind.temperature_status = static_cast<std::int32_t>(TemperatureStatus::kTooOld);
  log_.add(2, "SW.elbow.STATE", blind);
  log_.add_bytes(3, "SW.elbow.STATE", {1, 2, 3});
  log_.add_bytes(3, "CAMERA", std::vector<std::uint8_t>(10000));
  const FrictionLog log = read_friction_log(path_, "");
  EXPECT_EQ(log.joint, "SW.elbow");
  EXPECT_EQ(log.joint_model, "rhs17-6006");
  EXPECT_EQ(log.gear_ratio, 50.0);
  ASSERT_EQ(log.samples.size(), 2U);
  EXPECT_DOUBLE_EQ(log.samples[0].time_s, 0.005);
  EXPECT_EQ(log.samples[0].torque_applied_Nm, 1.25);
  EXPECT_TRUE(log.samples[0].tracking);
  EXPECT_EQ(log.samples[0].temperature_C, 21.0);
  EXPECT_TRUE(std::isnan(log.samples[1].temperature_C)) << "an untrusted temperature must not be used";
}

TEST_F(FrictionLogTest, RefusesALogOfSeveralJointsUnlessOneIsNamed) {
  for (const char* joint : {"elbow", "wrist"}) {
    log_.add(0, std::string("SW.") + joint + ".LIMITS", limits());
    log_.add(1, std::string("SW.") + joint + ".STATE", state(5));
  }
  EXPECT_NE(refusal().find("--joint"), std::string::npos) << refusal();
  EXPECT_EQ(read_friction_log(path_, "wrist").joint, "SW.wrist");
  EXPECT_NE(refusal("knee").find("no states"), std::string::npos);
}

TEST_F(FrictionLogTest, RefusesALogWithoutLimitsOrAcrossARestart) {
  log_.add(1, "SW.elbow.STATE", state(5));
  EXPECT_NE(refusal().find("LIMITS"), std::string::npos) << refusal();
  log_.add(2, "SW.elbow.LIMITS", limits());
  EXPECT_EQ(refusal(), "accepted");
  state_v1 later = state(1);
  later.session_id = 8;
  log_.add(3, "SW.elbow.STATE", later);
  EXPECT_NE(refusal().find("restarted"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace strainwave
