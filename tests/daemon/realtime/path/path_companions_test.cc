// SPDX-License-Identifier: BSD-3-Clause
// Joints of different kinds on one path. Their delays, jerk limits and springs make them lag differently, but they must move together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "control/table/gain_table_json.h"
#include "daemon/realtime/path/path_follower.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kFar_rad = 0.4;
constexpr double kFastest_rad_s = 0.4;
constexpr double kDuration_s = 2.0;
constexpr double kTogether_rad = 0.4e-3;
/// The tolerance if the path's time stops within a tenth of a second. Its acceleration begins at once, but a spring and a jerk limit round it.
constexpr double kBrakedTogether_rad = 1.2e-3;

BenchJoint companion_on_a_spring(double link_kgm2) {
  BenchJoint joint = demo_joint();
  JointPlantConfig plant = flexible_plant();
  plant.effects.transmission->link_inertia_kgm2 = link_kgm2;
  put_on_spring(joint, plant);
  return joint;
}

GainTable companion_table(const char* total) {
  return read_gain_table(std::string(STRAINWAVE_SOURCE_DIR "/data/tables/") + total + "/c4.json");
}

/// A rigid joint, one with a jerk limit, one with a spring, and one with a heavy link on a spring.
class PathCompanions : public ::testing::Test {
 protected:
  PathCompanions() : bench_(joints()), went_(4) {
    bench_.bring_to_hold(0);
    bench_.bring_to_hold(1);
    bench_.bring_to_hold(2, companion_table("total-0.178"));
    bench_.bring_to_hold(3, companion_table("total-0.356"));
    KnotPath path;
    path.count = 3;
    path.knots[1] = {0.5 * kDuration_s, 0.5 * kFar_rad, kFastest_rad_s * 0.75};
    path.knots[2] = {kDuration_s, kFar_rad, 0.0};
    for (std::size_t i = 0; i < went_.size(); ++i) {
      const auto slot = bench_.joint(i).joint().path_slots.hand_over({7, 4, path});
      EXPECT_EQ(bench_.order(i, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
                Reason::kAccepted);
    }
    EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kAccepted);
  }
  static std::vector<BenchJoint> joints() {
    BenchJoint smooth = demo_joint();
    smooth.loop.controller.jerk_limit_rad_s3 = 1500.0;
    return {demo_joint(), smooth, companion_on_a_spring(0.089), companion_on_a_spring(0.267)};
  }
  void run(double duration_s) {
    for (int k = 0; k < std::lround(1e3 * duration_s); ++k) {
      bench_.step();
      for (std::size_t i = 0; i < went_.size(); ++i)
        went_[i].push_back(bench_.drive(i).simulated().plant().link_state().position_rad);
    }
  }
  /// The largest distance between two joints at any time.
  double farthest_apart_rad() const {
    double farthest_rad = 0.0;
    for (std::size_t k = 0; k < went_[0].size(); ++k) {
      double lowest_rad = went_[0][k];
      double highest_rad = went_[0][k];
      for (const auto& joint : went_) {
        lowest_rad = std::min(lowest_rad, joint[k]);
        highest_rad = std::max(highest_rad, joint[k]);
      }
      farthest_rad = std::max(farthest_rad, highest_rad - lowest_rad);
    }
    return farthest_rad;
  }
  bool all_hold() const {
    for (std::size_t i = 0; i < went_.size(); ++i)
      if (bench_.mode(i) != Mode::kHolding) return false;
    return true;
  }

  JointBench bench_;
  std::vector<std::vector<double>> went_;  ///< positions of the links
};

TEST_F(PathCompanions, LeaveGoAndArriveTogether) {
  run(kDuration_s + 0.2);
  EXPECT_LT(farthest_apart_rad(), kTogether_rad);
  EXPECT_TRUE(all_hold());
  for (const auto& joint : went_) EXPECT_NEAR(joint.back(), kFar_rad, 1e-4);
}

TEST_F(PathCompanions, PauseAndGoOnTogether) {
  run(0.8);
  ASSERT_EQ(bench_.order(3, OrderKind::kPausePath), Reason::kAccepted);
  run(0.5);
  ASSERT_EQ(bench_.order(1, OrderKind::kResumePath), Reason::kAccepted);
  run(kDuration_s);
  EXPECT_LT(farthest_apart_rad(), kBrakedTogether_rad);
  EXPECT_TRUE(all_hold());
}

}  // namespace
}  // namespace strainwave::testing
