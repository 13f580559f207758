// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/position_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/joint/reference_plant.h"

namespace strainwave {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

JointLoopConfig config() {
  JointLoopConfig config;
  config.limits.overspeed_rad_s = 5.0;
  config.controller.encoder_resolution_rad = 2e-5;
  return config;
}

class PositionCheckTest : public ::testing::Test {
 protected:
  PositionCheckTest() : check_(config()) { check_.set_joint(0.089, 4.0); }
  bool see(double position_rad, double torque_Nm = 0.0, bool driven = true, std::int64_t periods = 1) {
    now_ns_ += periods * kPeriod_ns;
    return check_.plausible(position_rad, torque_Nm, driven, now_ns_);
  }
  PositionCheck check_;
  std::int64_t now_ns_ = 0;
};

TEST_F(PositionCheckTest, RefusesAJump) {
  see(1.0);
  EXPECT_FALSE(see(1.02));
  EXPECT_TRUE(see(1.02)) << "one jump is one refusal";
}

TEST_F(PositionCheckTest, AllowsMoreAfterMissedPeriods) {
  see(1.0);
  EXPECT_TRUE(see(1.02, 0.0, true, 4));
}

TEST_F(PositionCheckTest, ConcludesNothingFromAJointThatIsNotDriven) {
  see(1.0, 0.0, false);
  EXPECT_TRUE(see(2.0, 0.0, false));
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(see(2.0, i % 2 == 0 ? 30.0 : -30.0, false));
}

TEST_F(PositionCheckTest, RefusesAPositionThatStandsWhileTheTorqueMustMoveTheJoint) {
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(see(1.0, 0.0));
  int cycles = 0;
  while (cycles < 1000 && see(1.0, 20.0)) ++cycles;
  // 20 - 12 N.m accelerate 0.089 kg.m^2 over 2e-4 rad in 2.1 ms.
  EXPECT_NEAR(cycles, 2, 1);
}

// At the end of a motion, pushes move the joint within a coarse count, and friction ends each.
TEST_F(PositionCheckTest, BelievesPushesToAndFroThatTheReadingIsTooCoarseFor) {
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(see(1.0, 0.0));
  for (int push = 0; push < 1000; ++push) {
    const double side = push % 2 == 0 ? 1.0 : -1.0;
    ASSERT_TRUE(see(1.0, side * 25.0)) << push;
    for (int i = 0; i < 9; ++i) ASSERT_TRUE(see(1.0, 0.0)) << push;
  }
}

// The physics never contradict the check, whatever the torque and the constant load.
TEST(PositionCheck, BelievesEverySoundJoint) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> torque(-34.0, 34.0);
  std::uniform_int_distribution<int> duration(1, 60);
  for (const double temperature_C : {-10.0, 20.0, 45.0}) {
    for (const double load_Nm : {0.0, 8.0, -15.0}) {
      JointPlant plant(realistic_plant());
      JointLoopConfig wide = config();
      wide.limits.overspeed_rad_s = 50.0;
      PositionCheck check(wide);
      const FrictionParameters friction = plant.config().joint.friction.at(temperature_C);
      check.set_joint(plant.config().joint.inertia_kgm2, friction.static_Nm);
      double torque_Nm = load_Nm;
      int left = 0;
      for (std::int64_t cycle = 1; cycle < 30000; ++cycle) {
        if (left-- == 0) {
          torque_Nm = cycle % 3 == 0 ? load_Nm : torque(random);
          left = duration(random);
        }
        // A damper keeps the speed in the plant's range.
        const double damped_Nm = torque_Nm - 3.0 * plant.state().velocity_rad_s;
        plant.set_ambient_temperature(temperature_C);
        plant.step(damped_Nm, load_Nm);
        ASSERT_TRUE(check.plausible(plant.measured_position_rad(), plant.applied_torque_Nm(), true,
                                    cycle * kPeriod_ns))
            << "cycle " << cycle << ", load " << load_Nm << ", " << temperature_C << " degC";
      }
    }
  }
}

}  // namespace
}  // namespace strainwave
