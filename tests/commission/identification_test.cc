// SPDX-License-Identifier: BSD-3-Clause
#include "commission/identification.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/commission/random_joints.h"

namespace strainwave::testing {
namespace {

/// A few joints of the study (tests/commission/study.cc) and what is found of each. Made once: each takes seconds.
struct Found {
  RandomJoint joint;
  CommissionedJoint run;
  JointEstimates estimates;
};

const std::vector<Found>& found() {
  static const std::vector<Found> all = [] {
    std::vector<Found> list;
    for (const std::uint64_t seed : {2U, 4U, 6U}) {
      const RandomJoint joint = random_joint(seed);
      CommissionedJoint run = excite(joint);
      const JointEstimates estimates = identify(run.trace, joint.told);
      list.push_back({joint, std::move(run), estimates});
    }
    return list;
  }();
  return all;
}

/// The largest share by which `quantity` is off.
double worst(const std::string& quantity) {
  double most = 0.0;
  int count = 0;
  for (const Found& one : found())
    for (const Comparison& comparison : compare(one.joint, one.estimates)) {
      if (comparison.quantity != quantity) continue;
      ++count;
      most = std::max(most, comparison.error());
    }
  return count > 0 ? most : 1.0;
}

TEST(Identification, FindsInertiasAndSpringWithinTheGoals) {
  EXPECT_LT(worst("resonance"), 0.02);
  EXPECT_LT(worst("stiffness"), 0.05);
  EXPECT_LT(worst("link inertia"), 0.05);
  EXPECT_LT(worst("motor inertia"), 0.05);
}

TEST(Identification, FindsFrictionWithinThreePerCentAtAllSpeeds) {
  EXPECT_LT(worst("friction"), 0.03);
  for (const Found& one : found()) EXPECT_GE(one.estimates.friction.size(), 3U);
}

TEST(Identification, FindsTheDelayWithinAFifthOfAMillisecond) {
  for (const Found& one : found())
    for (const Comparison& comparison : compare(one.joint, one.estimates))
      if (comparison.quantity == "delay") {
        EXPECT_LT(std::abs(comparison.found.value - comparison.truth), 0.2e-3);
      }
}

TEST(Identification, SaysWhichWayTheTorqueActs) {
  for (const Found& one : found()) {
    EXPECT_EQ(find_direction(one.run.trace), 1);
    JointTrace reversed = one.run.trace;
    for (JointSample& sample : reversed.samples) sample.motor_position_rad *= -1.0;
    EXPECT_EQ(find_direction(reversed), -1);
  }
}

TEST(Identification, FindsTheTorqueOfBreakingAwayBothWays) {
  for (const Found& one : found()) {
    const JointPlantConfig& plant = one.joint.drive.plant;
    const double truth = plant.joint.friction.at(one.joint.drive.ambient.at(0.0)).static_Nm;
    // Gravity helps one way and is in the way of the other; its mean is left out.
    const auto& [up, down] =
        std::pair(one.estimates.breakaway_positive_Nm, one.estimates.breakaway_negative_Nm);
    ASSERT_TRUE(up && down);
    EXPECT_NEAR(0.5 * (up->value + down->value) / truth, 1.0, 0.35);
  }
}

TEST(Identification, FindsNothingInATraceAtRest) {
  JointTrace trace{0.001, 1e-5, std::vector<JointSample>(2000)};
  const JointEstimates estimates = identify(trace, found().front().joint.told);
  EXPECT_FALSE(estimates.direction);
  EXPECT_FALSE(estimates.motion);
  EXPECT_TRUE(estimates.friction.empty());
}

}  // namespace
}  // namespace strainwave::testing
