// SPDX-License-Identifier: BSD-3-Clause
// How the controller uses the load that a stream reports, on the simulated joint.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/control/controlled_joint.h"

namespace strainwave::testing {
namespace {

constexpr double kOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kAmplitude_rad = 0.5;

StreamSample sine(double t_s, const StreamLoad& load) {
  return {kAmplitude_rad * std::sin(kOmega_rad_s * t_s),
          kAmplitude_rad * kOmega_rad_s * std::cos(kOmega_rad_s * t_s),
          -kAmplitude_rad * kOmega_rad_s * kOmega_rad_s * std::sin(kOmega_rad_s * t_s),
          2,
          0,
          load};
}

/// A load that rises to 12 N.m, and its report in the stream.
struct Coming {
  double over_s = 0.0;  ///< duration of the linear rise
  int ahead = 0;        ///< periods that samples are stamped ahead; 0: no stamp
  double told = 0.0;    ///< reported share of the load
};

/// Largest following error from 0.1 s before the load begins to rise until 0.5 s after that.
double error_when_a_load_comes(const Coming& coming) {
  constexpr int kComes = 3000;
  const auto load_Nm = [&](int k) {
    return 12.0 * std::clamp((k - kComes) * 1e-3 / coming.over_s, 0.0, 1.0);
  };
  ControlledJoint loop;
  double largest_rad = 0.0;
  for (int k = 0; k < kComes + 500; ++k) {
    loop.load_torque_Nm = load_Nm(k);
    if (k % 10 == 0) {
      const int then = k + coming.ahead;
      StreamSample sample = sine(then * 1e-3, {coming.told * load_Nm(then), 0.0});
      sample.in_periods = coming.ahead;
      loop.controller().follow(sample, k == 0, 0.0, {});
    }
    const JointStep step = loop.step();
    if (k >= kComes - 100)
      largest_rad =
          std::max(largest_rad, std::abs(step.ordered_reference.position_rad - loop.position_rad()));
  }
  return largest_rad;
}

TEST(JointControllerLoad, OneThatIsToldForItsTimeDisturbsLess) {
  const double untold_rad = error_when_a_load_comes({0.01, 30, 0.0});
  EXPECT_LT(error_when_a_load_comes({0.01, 30, 1.0}), 0.25 * untold_rad);
  EXPECT_GT(error_when_a_load_comes({0.01, 30, -1.0}), 1.3 * untold_rad) << "it is the torque that helps";
}

// The observer finds a load in about 10 ms. A sample without a stamp reports it as late as that, so only a slow load gains.
TEST(JointControllerLoad, OneThatIsToldWhenItComesDisturbsLessWhereItComesSlowly) {
  EXPECT_LT(error_when_a_load_comes({0.2, 0, 1.0}), 0.5 * error_when_a_load_comes({0.2, 0, 0.0}));
}

TEST(JointControllerLoad, IsNotTakenTwiceByWhatEstimatesTheLoad) {
  ControlledJoint loop;
  loop.load_torque_Nm = 8.0;
  JointStep step;
  for (int k = 0; k < 3000; ++k) {
    if (k % 10 == 0) loop.controller().follow(sine(k * 1e-3, {8.0, 0.0}), k == 0, 0.0, {});
    step = loop.step();
  }
  EXPECT_NEAR(step.load_Nm, 0.0, 2.0) << "what the stream says is not learned";
  EXPECT_NEAR(step.ordered_reference.position_rad, loop.position_rad(), 2e-3) << "a period later";
}

TEST(JointControllerLoad, TorqueStaysWithinItsLimitWhateverIsTold) {
  ControlledJoint loop;
  bool saturated = false;
  for (int k = 0; k < 1000; ++k) {
    const double torque_Nm = k % 200 < 100 ? 3.0 * kReferencePeakTorque_Nm : -3.0 * kReferencePeakTorque_Nm;
    if (k % 10 == 0) loop.controller().follow(sine(k * 1e-3, {torque_Nm, 5.0}), k == 0, 0.0, {});
    const JointStep step = loop.step();
    ASSERT_LE(std::abs(step.output.torque_Nm), kReferencePeakTorque_Nm);
    saturated = saturated || step.output.saturated;
  }
  EXPECT_TRUE(saturated);
}

// The reported torque is up to one interval late, which is 0.4 N.m. Friction holds that difference.
TEST(JointControllerLoad, FollowsTheTorqueThatIsToldWhileTheJointRests) {
  ControlledJoint loop;
  JointStep step;
  const auto follow_one_period = [&](int k, double torque_Nm) {
    if (k % 10 == 0) loop.controller().follow({0.1, 0.0, 0.0, 0, 0, {torque_Nm, 0.0}}, k == 0, 0.0, {});
    loop.load_torque_Nm = torque_Nm;
    step = loop.step();
  };
  for (int k = 0; k < 500; ++k) follow_one_period(k, 0.0);
  ASSERT_EQ(step.phase, MotionPhase::kResting);
  const double before_Nm = step.output.torque_Nm;
  for (int k = 500; k < 1000; ++k) {
    follow_one_period(k, std::min(4.0, 0.04 * (k - 500)));
    ASSERT_EQ(step.phase, MotionPhase::kResting) << k;
    ASSERT_NEAR(loop.position_rad(), 0.1, 3.0 * kCount_rad) << k;
  }
  EXPECT_NEAR(step.output.torque_Nm - before_Nm, 4.0, 1e-9);
}

// A load that leaves little torque slows a move down, but not the path after it.
TEST(JointControllerLoad, OfAMoveDoesNotSlowThePathAfterIt) {
  const auto references_rad = [](double load_Nm) {
    JointControllerConfig config = realistic_config();
    config.motion = {10.0, 100.0, 1e4};
    config.torque_limit_Nm = 18.0;
    ControlledJoint loop(realistic_plant(), config);
    loop.load_torque_Nm = load_Nm;
    loop.controller().set_target(1.0, 0.0);
    loop.run(2.0);
    loop.load_torque_Nm = 0.0;
    loop.run(0.5);
    constexpr double kPath_rad_s = 17.5;
    std::vector<double> along_rad;
    for (int k = 0; k < 400; ++k) {
      const double angle_rad = 1e-3 * kPath_rad_s * k;
      loop.controller().follow_path(1.0 + 0.3 * (1.0 - std::cos(angle_rad)),
                                    0.3 * kPath_rad_s * std::sin(angle_rad), 1, {});
      along_rad.push_back(loop.step().ordered_reference.position_rad);
    }
    return along_rad;
  };
  const std::vector<double> without_rad = references_rad(0.0);
  const std::vector<double> after_rad = references_rad(14.0);
  for (std::size_t k = 0; k < without_rad.size(); ++k) ASSERT_NEAR(after_rad[k], without_rad[k], 1e-4) << k;
}

// The load stays the same when the stream ends. The joint must not jump, neither then nor when the next motion begins.
TEST(JointControllerLoad, MakesNoStepWhenTheStreamIsOver) {
  ControlledJoint loop;
  loop.load_torque_Nm = 8.0;
  for (int k = 0; k < 3000; ++k) {
    if (k % 10 == 0)
      loop.controller().follow({1e-4 * std::min(k, 2000), k < 2000 ? 0.1 : 0.0, 0.0, 1, 0, {8.0, 0.0}},
                               k == 0, 0.0, {});
    loop.step();
  }
  loop.controller().stop();
  double farthest_rad = 0.0;
  const double rest_rad = loop.position_rad();
  for (int k = 0; k < 1000; ++k) {
    loop.step();
    farthest_rad = std::max(farthest_rad, std::abs(loop.position_rad() - rest_rad));
  }
  EXPECT_LT(farthest_rad, 3.0 * kCount_rad);
  loop.controller().set_target(0.4, 0.2);
  double error_rad = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const JointStep step = loop.step();
    error_rad = std::max(error_rad, std::abs(step.ordered_reference.position_rad - loop.position_rad()));
  }
  EXPECT_LT(error_rad, 2e-3);
  EXPECT_NEAR(loop.position_rad(), 0.4, 0.5e-3);
}

}  // namespace
}  // namespace strainwave::testing
