// Joints that are declared rigid, behind a drive whose current loop lags, and what the controller is told of it. The simulator's joint.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/control/controlled_joint.h"
#include "tests/control/watched_joint.h"

namespace strainwave::testing {
namespace {

struct Lagging {
  int fallen = 0;
  double worst_counts = 0.0;     ///< from the target, after four seconds
  double mean_settling_s = 0.0;  ///< into two counts
};

/// 60 joints with a current loop of `least_s` to `most_s`, of which the controller is told the share `told`. One step each, of 0.01 to 1 rad.
Lagging move_joints(double least_s, double most_s, double told) {
  constexpr int kJoints = 60;
  Draw draw(3);
  Lagging lagging;
  for (int i = 0; i < kJoints; ++i) {
    JointPlantConfig plant = realistic_plant();
    plant.effects.drive.current_loop_s = draw.between(least_s, most_s);
    JointControllerConfig config = realistic_config();
    config.motion = {5.0, 60.0, 60.0};
    if (told > 0.0) config.current_loop_s = told * plant.effects.drive.current_loop_s;
    ControlledJoint loop(plant, config);
    loop.temperature_C = draw.between(-10.0, 40.0);
    const double target_rad = draw.in_proportion(0.01, 1.0);
    loop.controller().set_target(target_rad);
    bool fell = false;
    int settled = 0;
    for (int k = 0; k < 4000; ++k) {
      fell = loop.step().monitor != MonitorState::kWatching || fell;
      if (std::abs(loop.position_rad() - target_rad) > 2.0 * kCount_rad) settled = k + 1;
    }
    lagging.fallen += fell ? 1 : 0;
    lagging.worst_counts =
        std::max(lagging.worst_counts, std::abs(loop.position_rad() - target_rad) / kCount_rad);
    lagging.mean_settling_s += 1e-3 * settled / kJoints;
  }
  std::printf(
      "current loop of %.2f to %.2f ms, told %.1f of it: %d of %d fall back, settled after %.3f s, off by at "
      "most %.2f counts\n",
      1e3 * least_s, 1e3 * most_s, told, lagging.fallen, kJoints, lagging.mean_settling_s,
      lagging.worst_counts);
  return lagging;
}

TEST(CurrentLoopOfARigidJoint, MakesItFallBackWhereItIsNotTold) {
  EXPECT_GT(move_joints(3e-4, 5e-4, 0.0).fallen, 15);
  EXPECT_GT(move_joints(5e-4, 1e-3, 0.0).fallen, 45);
}

// Without a lag the same moves take 0.104 s. From half a period on a push and its undoing need more than the torque limit now and then.
TEST(CurrentLoopOfARigidJoint, IsHarmlessUpToHalfAPeriodWhereItIsToldAndNearlySoUpToAPeriod) {
  const Lagging told = move_joints(3e-4, 5e-4, 1.0);
  EXPECT_EQ(told.fallen, 0);
  EXPECT_LT(told.worst_counts, 1.0);
  EXPECT_LT(told.mean_settling_s, 0.12);
  EXPECT_LE(move_joints(5e-4, 1e-3, 1.0).fallen, 2);
  EXPECT_LT(move_joints(1e-3, 2e-3, 1.0).fallen, 15);
}

TEST(CurrentLoopOfARigidJoint, IsRatherToldTooShortThanTooLong) {
  for (const double told : {0.5, 0.8}) EXPECT_EQ(move_joints(3e-4, 5e-4, told).fallen, 0) << told;
  EXPECT_LE(move_joints(3e-4, 5e-4, 1.2).fallen, 2);
  EXPECT_GT(move_joints(3e-4, 5e-4, 2.0).fallen, 30);
}

}  // namespace
}  // namespace strainwave::testing
