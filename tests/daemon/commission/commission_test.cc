// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/commission/commission.h"

#include <gtest/gtest.h>
#include <signal.h>

#include "tests/daemon/commission/simulated_arm.h"

namespace strainwave {
namespace {

TEST_F(CommissionTest, IsEndedByASignalAndKeepsWhatThereIs) {
  // The signal is pending until the first step that moves checks for it.
  ::sigset_t term;
  ::sigemptyset(&term);
  ::sigaddset(&term, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &term, nullptr);
  ::raise(SIGTERM);
  EXPECT_EQ(run(kArm), ExitStatus::kInterrupted);
  EXPECT_EQ(record().problem, "interrupted by a signal");
}

TEST_F(CommissionTest, MovesInsideTheLimitsOfTheConfiguration) {
  const CommissioningConfig config = commissioning_config(read(kArm), 0);
  const ExcitationLimits& limits = config.excitation.limits;
  EXPECT_EQ(limits.torque_Nm, 34.0);
  EXPECT_EQ(limits.position_max_rad, 0.5);
  EXPECT_EQ(limits.speed_rad_s, 3.0);
  EXPECT_EQ(config.configured.load_inertia_kgm2, 0.1);
  EXPECT_FALSE(config.configured.damping_Nms_rad || config.configured.gravity);
  const std::string without = replaced(kArm, "motor_inertia_kgm2 = 0.089\nload_inertia_kgm2 = 0.1\n", "");
  const ConfiguredNumbers unknown = commissioning_config(configuration(without), 0).configured;
  EXPECT_FALSE(unknown.motor_inertia_kgm2 || unknown.load_inertia_kgm2);
}

TEST_F(CommissionTest, RefusesWhatItCannotMeasureAndSaysWhy) {
  std::string rigid =
      replaced(kArm, "model = \"flexible\"\ngear = \"csf-17-50\"\nmotor_inertia_kgm2 = 0.089\n",
               "model = \"rigid\"\n");
  rigid = replaced(rigid, "spring = {damping_Nms_rad = 1.0, lost_motion_rad = 0.0005}\n", "");
  rigid = replaced(rigid, "load_inertia_kgm2", "inertia_kgm2");
  expect_mentions(refusal(rigid), {"joint.model = \"rigid\"", "only \"flexible\""});
  expect_mentions(refusal(replaced(kArm, "lost_motion_rad = 0.0005", "lost_motion_rad = 0.0")),
                  {"lost_motion_rad = 0", "above 0"});
  expect_mentions(refusal(example("epos4-position.toml")), {"drive_mode"});
  expect_mentions(refusal(replaced(kArm, "torque_limit_Nm = 34", "torque_limit_Nm = 340")),
                  {"torque_limit_Nm = 340", "at most 34", "csf-17-50"});
  expect_mentions(testing::refusal_of([&] {
                    (void)commission_joint(read(kArm), folder_ / "c.toml", "wrist", folder_ / "out", out_);
                  }),
                  {"--commission wrist", "elbow"});
}

}  // namespace
}  // namespace strainwave
