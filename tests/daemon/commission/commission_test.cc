// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/commission/commission.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <sstream>

#include "commission/commission_record.h"
#include "tests/daemon/config/config_file_test.h"

namespace strainwave {
namespace {

constexpr const char* kArm = R"(
[daemon]
real_time = "ignore"
[security]
unsigned_orders = "allow"
[[joint]]
name = "elbow"
joint_model = "arm"
model = "flexible"
gear = "csf-17-50"
motor_inertia_kgm2 = 0.089
load_inertia_kgm2 = 0.1
gear_ratio = 50
driver = "simulated"
[joint.limits]
position_min_rad = -3
position_max_rad = 0.5
speed_limit_rad_s = 3.0
acceleration_rad_s2 = 30
following_error_rad = 0.1
torque_limit_Nm = 100
[joint.simulated]
ambient_temperature_C = "constant:20"
spring = {damping_Nms_rad = 1.0, lost_motion_rad = 0.0005}
drive = {current_loop_s = 0.0003}
sliding = {transmitted_share = 0.05}
)";

class CommissionTest : public ConfigFileTest {
 protected:
  ExitStatus run(const std::string& text) {
    return commission_joint(configuration(text), folder_ / "c.toml", "elbow", folder_ / "out", out_);
  }
  DaemonConfig configuration(const std::string& text) {
    std::ofstream(folder_ / "c.toml") << text;
    return read_config(folder_ / "c.toml", ConfigUse::kCommission);
  }
  CommissionRecord record() { return read_commission_record(folder_ / "out").value(); }
  std::string refusal(const std::string& text) {
    const DaemonConfig config = configuration(text);
    return testing::refusal_of([&] { (void)commissioning_config(config, 0); });
  }
  std::ostringstream out_;
};

TEST_F(CommissionTest, MeasuresASimulatedJointAsConfigured) {
  EXPECT_EQ(run(kArm), ExitStatus::kDone) << out_.str();
  const CommissionRecord found = record();
  EXPECT_EQ(found.problem, "");
  EXPECT_TRUE(found.simulated);
  EXPECT_LT(found.joint_time_s, 180.0);
  EXPECT_NEAR(found.temperature_C.value_or(0.0), 20.0, 5.0);
  for (const char* name : {"identity", "direction", "breakaway", "friction", "motion", "comparison"})
    EXPECT_NE(out_.str().find(std::string("  ") + name + ": "), std::string::npos) << name;

  std::ostringstream again;
  EXPECT_EQ(
      commission_joint(read_config(folder_ / "c.toml"), folder_ / "c.toml", "elbow", folder_ / "out", again),
      ExitStatus::kDone);
  EXPECT_NE(again.str().find("motion: done before, not run again"), std::string::npos) << again.str();
  EXPECT_EQ(record().joint_time_s, found.joint_time_s) << "nothing has moved";
}

TEST_F(CommissionTest, EndsWithTheNameOfALoadThatIsWrong) {
  std::string text = kArm;
  text.append("[joint.simulated.link]\ninertia_kgm2 = 0.2\n");
  EXPECT_EQ(run(text), ExitStatus::kRefused) << out_.str();
  EXPECT_TRUE(record().problem.starts_with("load_inertia_kgm2 = 0.1 is wrong: ")) << record().problem;
}

TEST_F(CommissionTest, MeasuresTheInertiasOfAJointThatHasNoneInItsConfiguration) {
  std::string text = replaced(kArm, "motor_inertia_kgm2 = 0.089\nload_inertia_kgm2 = 0.1\n", "");
  text.append("inertia_kgm2 = 0.04\n[joint.simulated.link]\ninertia_kgm2 = 0.06\n");
  EXPECT_TRUE(error_of(text).find("motor_inertia_kgm2") != std::string::npos) << "the daemon needs it";
  EXPECT_EQ(run(text), ExitStatus::kDone) << out_.str();
  for (const CommissionValue& value : record().values) {
    if (value.key == "motor_inertia_kgm2") {
      EXPECT_NEAR(value.measured.value, 0.04, 0.002);
    } else if (value.key == "load_inertia_kgm2") {
      EXPECT_NEAR(value.measured.value, 0.06, 0.003);
    }
    EXPECT_EQ(value.configured.has_value(),
              value.key == "stiffness_Nm_rad" || value.key == "simulated.delay_periods")
        << value.key;
  }
}

TEST_F(CommissionTest, IsEndedByASignalAndKeepsWhatThereIs) {
  // Taken as soon as the first step that moves looks for it.
  ::sigset_t term;
  ::sigemptyset(&term);
  ::sigaddset(&term, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &term, nullptr);
  ::raise(SIGTERM);
  EXPECT_EQ(run(kArm), ExitStatus::kInterrupted);
  EXPECT_EQ(record().problem, "interrupted by a signal");
}

TEST_F(CommissionTest, MovesInsideTheLimitsOfConfigurationAndGear) {
  const CommissioningConfig config = commissioning_config(read(kArm), 0);
  const ExcitationLimits& limits = config.excitation.limits;
  EXPECT_EQ(limits.torque_Nm, 34.0) << "the gear's repeated peak torque";
  EXPECT_EQ(limits.position_max_rad, 0.5);
  EXPECT_EQ(limits.speed_rad_s, 3.0);
  EXPECT_EQ(config.configured.load_inertia_kgm2, 0.1);
  EXPECT_FALSE(config.configured.damping_Nms_rad || config.configured.gravity);
}

TEST_F(CommissionTest, RefusesWhatItCannotMeasureAndSaysWhy) {
  std::string rigid =
      replaced(kArm, "model = \"flexible\"\ngear = \"csf-17-50\"\nmotor_inertia_kgm2 = 0.089\n",
               "model = \"rigid\"\n");
  rigid = replaced(rigid, "spring = {damping_Nms_rad = 1.0, lost_motion_rad = 0.0005}\n", "");
  rigid = replaced(rigid, "load_inertia_kgm2", "inertia_kgm2");
  expect_mentions(refusal(rigid), {"joint.model = \"rigid\"", "\"flexible\" is allowed"});
  expect_mentions(refusal(replaced(kArm, "lost_motion_rad = 0.0005", "lost_motion_rad = 0.0")),
                  {"lost_motion_rad = 0", "above 0"});
  expect_mentions(refusal(example("epos4-position.toml")), {"drive_mode"});
  expect_mentions(testing::refusal_of([&] {
                    (void)commission_joint(read(kArm), folder_ / "c.toml", "wrist", folder_ / "out", out_);
                  }),
                  {"--commission wrist", "elbow"});
}

}  // namespace
}  // namespace strainwave
