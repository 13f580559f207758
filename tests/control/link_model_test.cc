// SPDX-License-Identifier: BSD-3-Clause
// The two-mass model against mechanics: conservation of momentum, and the undamped oscillation of a linear spring.
#include "control/joint/link_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/joint/gear_catalogue.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kLimit_Nm = 34.0;

LinkModel linear(double link_kgm2 = 0.1, double stiffness_Nm_rad = 10000.0) {
  return {0.089, link_kgm2, TorsionSpring::linear(stiffness_Nm_rad), 0.0, {}};
}

double momentum_Nms(const LinkModel& joint, const LinkState& at) {
  return joint.motor_inertia_kgm2 * at.motor_velocity_rad_s +
         joint.link_inertia_kgm2 * at.link_velocity_rad_s;
}

TEST(LinkModel, TakesUpTheTorquesMomentumAndNothingElse) {
  LinkModel joint = linear();
  joint.spring = find_gear("csf-17-50")->spring;
  joint.damping_Nms_rad = 2.0;
  LinkState state{0.1, 0.5, 0.1004, -0.3};
  for (int k = 0; k < 50; ++k) {
    const double torque_Nm = k % 7 - 3.0;
    const LinkState next = joint.advance(state, torque_Nm, kPeriod_s).end;
    EXPECT_NEAR(momentum_Nms(joint, next) - momentum_Nms(joint, state), torque_Nm * kPeriod_s, 1e-15);
    state = next;
  }
}

TEST(LinkModel, SwingsAsFastAsItsSpringAndInertiasSay) {
  const LinkModel joint = linear();
  const double swing_rad_s = std::sqrt(10000.0 * (1.0 / 0.089 + 1.0 / 0.1));
  LinkState state{0.0, 0.0, 1e-3, 0.0};
  for (int k = 1; k <= 50; ++k) {
    state = joint.advance(state, 0.0, kPeriod_s).end;
    EXPECT_NEAR(state.motor_position_rad - state.link_position_rad,
                1e-3 * std::cos(k * kPeriod_s * swing_rad_s), 2e-6);
  }
}

TEST(LinkModel, StandsWhereGravityAndWindUpBalance) {
  LinkModel joint = linear();
  joint.gravity = {10.0, -0.5};
  const double link_rad = 0.3;
  const double held_Nm = joint.gravity.at(link_rad);
  const LinkState rest{link_rad, 0.0, link_rad + held_Nm / 10000.0, 0.0};
  const LinkState after = joint.advance(rest, held_Nm, kPeriod_s).end;
  EXPECT_NEAR(after.link_position_rad, rest.link_position_rad, 1e-15);
  EXPECT_NEAR(after.motor_velocity_rad_s, 0.0, 1e-12);
  EXPECT_LT(joint.advance(rest, 0.0, kPeriod_s).end.motor_position_rad, rest.motor_position_rad) << "it sags";
}

TEST(LinkModel, ItsRegulatorBringsEveryErrorToNothingOnEverySlopeAndLoad) {
  for (const double link_kgm2 : {0.01, 0.03, 0.1, 0.3, 1.0})
    for (const char* gear : {"csf-14-50", "csf-17-50", "csf-25-100"}) {
      LinkModel joint = linear(link_kgm2);
      joint.spring = find_gear(gear)->spring;
      const LinkGains gains = joint.regulate(kLimit_Nm, kPeriod_s);
      LinkState state{50e-6, 0.01, -100e-6, -0.02};
      for (int k = 0; k < 300; ++k) {
        const LinkState alone = joint.advance(state, 0.0, kPeriod_s).end;
        state = joint.advance(state, regulated_torque_Nm(gains, {}, alone), kPeriod_s).end;
      }
      EXPECT_LT(std::abs(state.link_position_rad), 1e-7) << gear << " " << link_kgm2;
      EXPECT_LT(std::abs(state.motor_velocity_rad_s), 1e-5) << gear << " " << link_kgm2;
    }
}

}  // namespace
}  // namespace strainwave
