// The daemon's controller on joints that are not what table and configuration say. The joint is tests/support/two_mass_joint.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/control/watched_joint.h"
#include "tests/support/catalogue_joint.h"

namespace strainwave::testing {
namespace {

void expect_quiet_after_half_a_second(const TwoMassData& data, const GainTable& table, const char* what) {
  for (const bool rigid : {false, true})
    for (const double target_rad : {0.001, 0.01, 0.1, 1.0}) {
      const Outcome outcome = run(data, table, rigid, {target_rad}, 3000);
      // The motion's own reversal, when it begins to brake, is none of chatter.
      EXPECT_LE(outcome.last_reversal, outcome.first_motion + 500)
          << what << ", " << target_rad << " rad, " << (rigid ? "declared rigid" : "not declared rigid")
          << ", fallback " << outcome.fallback << ", fault " << outcome.fault << ", reversals "
          << outcome.reversals;
    }
}

TEST(Chatter, EndsWithinHalfASecondOfTheFirstMotionWhenTheTableIsForTenTimesTheInertia) {
  expect_quiet_after_half_a_second({}, table_for(0.89), "inertia x 10");
}

TEST(Chatter, EndsWithinHalfASecondOfTheFirstMotionWhenTheDelayIsTwoAndTheJointIsToldOne) {
  TwoMassData late;
  late.delay_periods = 2;
  expect_quiet_after_half_a_second(late, table_for(0.089), "delay 2");
}

TEST(Chatter, EndsWithinHalfASecondOfTheFirstMotionOnASpring) {
  for (const double link_kgm2 : {0.03, 0.089, 0.267}) {
    TwoMassData data;
    data.link_kgm2 = link_kgm2;
    expect_quiet_after_half_a_second(data, table_for(0.089 + link_kgm2), "spring");
  }
}

/// Of 60 moves of 1 mrad to 1 rad, those after whose first motion the torque reverses for more than half a second.
int count_late(const TwoMassData& data, double inertia_kgm2, bool rigid) {
  constexpr int kMoves = 60;
  Draw draw(7);
  int late = 0;
  int longest = 0;
  for (int i = 0; i < kMoves; ++i) {
    const Outcome outcome = run(data, table_for(inertia_kgm2), rigid, {draw.in_proportion(1e-3, 1.0)}, 3000);
    late += outcome.last_reversal > outcome.first_motion + 500 ? 1 : 0;
    longest = std::max(longest, outcome.last_reversal - outcome.first_motion);
  }
  std::printf("delay %d, link %g kg m2, %s: %d of %d moves reverse for more than 0.5 s, at most for %.1f s\n",
              data.delay_periods, data.link_kgm2, rigid ? "declared rigid" : "default", late, kMoves,
              1e-3 * std::max(0, longest));
  return late;
}

// Four moves say little. By default none of sixty lasts. A joint that is wrongly declared rigid swings past its target, is planned back to
// it, and swings past it again: a light link makes two strong turns of it now and then, and lasts a little longer.
TEST(Chatter, LastsOnlyWhereAJointIsWronglyDeclaredRigid) {
  TwoMassData slow;
  slow.delay_periods = 2;
  EXPECT_EQ(count_late(slow, 0.089, false), 0);
  EXPECT_EQ(count_late(slow, 0.089, true), 0);
  for (const double link_kgm2 : {0.02, 0.03, 0.089, 0.267}) {
    TwoMassData spring;
    spring.link_kgm2 = link_kgm2;
    EXPECT_EQ(count_late(spring, 0.089 + link_kgm2, false), 0);
    EXPECT_LE(count_late(spring, 0.089 + link_kgm2, true), link_kgm2 < 0.05 ? 3 : 0);
  }
}

TEST(Chatter, EndsWithinHalfASecondOfTheFirstMotionWithTheEncoderOnTheOtherSideOfASpring) {
  for (const double link_kgm2 : {0.1, 0.267}) {
    TwoMassData data;
    data.link_kgm2 = link_kgm2;
    data.encoder_on_link = true;
    expect_quiet_after_half_a_second(data, table_for(0.089 + link_kgm2), "encoder on the link");
  }
}

// Of a coarse encoder the law makes more of one count than the weakest chatter has torque, and a plain law goes on with it.
TEST(Chatter, EndsWithACoarseEncoderOnTheOtherSideOfASpring) {
  constexpr int kMoves = 120;
  Draw draw(5);
  int longest = 0;
  int late = 0;
  for (int i = 0; i < kMoves; ++i) {
    const double link_kgm2 = draw.in_proportion(0.15, 1.0);
    const double temperature_C = draw.between(-8.0, 45.0);
    TwoMassData data = catalogue_joint(temperature_C, link_kgm2, draw.in_proportion(0.005, 0.08), 1);
    data.counts_per_revolution = 65536.0;
    data.encoder_on_link = true;
    const GainTable table = scaled_table("total-1.089/c4.json", kMotor_kgm2 + link_kgm2);
    const Outcome outcome = run(data, table, false, {draw.in_proportion(1e-3, 0.3)}, 5000, temperature_C);
    const int lasts = std::max(0, outcome.last_reversal - outcome.first_motion);
    longest = std::max(longest, lasts);
    if (lasts > 500) ++late;
  }
  std::printf("coarse encoder of the link: %d of %d moves reverse for more than 0.5 s, at most for %.2f s\n",
              late, kMoves, 1e-3 * longest);
  EXPECT_LE(late, 2);
  EXPECT_LE(longest, 1000);
}

// Where friction gives way like a spring before it slides, a pulse of torque takes the joint across the next count's edge, and the count
// makes the next pulse. A count to either side is no velocity at rest, and what swings farther is seen, however coarse the counts.
TEST(Chatter, AtRestEndsWhereFrictionGivesWayAndTheEncoderIsCoarse) {
  constexpr int kMoves = 100;
  Draw draw(5);
  int longest = 0;
  for (int i = 0; i < kMoves; ++i) {
    TwoMassData data;
    data.link_kgm2 = draw.between(0.02, 0.27);
    data.delay_periods = i % 2 == 0 ? 2 : 1;
    data.counts_per_revolution = 32768.0;
    data.presliding_rad = draw.between(5e-5, 3e-4);
    data.presliding_damping_Nms_rad = draw.between(0.0, 20.0);
    const double target_rad = draw.in_proportion(1e-3, 0.1);
    const Outcome outcome = run(data, table_for(data.motor_kgm2 + data.link_kgm2), false, {target_rad}, 6000);
    longest = std::max(longest, outcome.last_reversal - outcome.first_motion);
    EXPECT_LE(outcome.last_reversal, outcome.first_motion + 1500)
        << target_rad << " rad, link " << data.link_kgm2 << ", delay " << data.delay_periods << ", reversals "
        << outcome.reversals << ", fallback " << outcome.fallback << ", fault " << outcome.fault;
  }
  std::printf("coarse encoder: %d moves, reverses for at most %.2f s\n", kMoves, 1e-3 * longest);
}

// However fine the encoder: a gear gives way by more than twenty of its counts, and comes back over its place.
TEST(Chatter, IsNotSeenWhereAJointIsTapped) {
  Draw draw(17);
  for (const double counts : {320000.0, 6553600.0})
    for (int i = 0; i < 20; ++i) {
      const double temperature_C = draw.between(-5.0, 40.0);
      const double link_kgm2 = draw.between(0.02, 0.2);
      const double damping_ratio = draw.between(0.01, 0.08);
      TwoMassData data = catalogue_joint(temperature_C, link_kgm2, damping_ratio, 1);
      for (double& slope : data.slopes_Nm_rad) slope *= draw.between(0.7, 1.3);
      data.counts_per_revolution = counts;
      const double push_Nm = draw.in_proportion(1.5, 7.5);
      const int every = static_cast<int>(draw.between(250.0, 3250.0));
      TwoMassJoint joint(data);
      JointController controller(config_for(false, joint.count_rad()));
      controller.load(table_for(data.motor_kgm2 + data.link_kgm2));
      controller.start(joint.reading_rad());
      for (int k = 0; k < 5000; ++k) {
        JointMeasurement measurement;
        measurement.joint_position_rad = joint.reading_rad();
        measurement.temperature_C = temperature_C;
        measurement.temperature_valid = true;
        const JointStep step = controller.step(measurement);
        ASSERT_EQ(step.monitor, MonitorState::kWatching) << counts << ", " << push_Nm << " N.m, " << k;
        const int tap = k % every;
        joint.step(step.output.torque_Nm, tap < 30 ? push_Nm * std::sin(std::numbers::pi * tap / 30.0) : 0.0);
      }
    }
}

// A step of a planned acceleration would swing the link, and the law would answer that.
TEST(Chatter, IsNotSeenWhereALinkAsHeavyAsTheMotorIsMovedToAndFro) {
  for (const double damping_ratio : {0.01, 0.02, 0.05})
    for (const double way_rad : {0.002, 0.01, 0.05, 0.3})
      for (const int every : {60, 100, 200, 1000}) {
        const TwoMassData data = catalogue_joint(20.0, 0.089, damping_ratio, 1);
        std::vector<double> targets;
        for (int i = 0; i < 16; ++i) targets.push_back(i % 2 == 0 ? way_rad : 0.0);
        const Outcome outcome = run(data, table_for(0.178), false, targets, every);
        EXPECT_LT(outcome.fallback, 0) << damping_ratio << ", " << way_rad << " rad every " << every << " ms";
      }
}

TEST(Chatter, TheFallbackMakesNoTorqueStep) {
  int fallen = 0;
  for (const double target_rad : {0.001, 0.01, 0.1, 1.0}) {
    const Outcome outcome = run({}, table_for(0.89), true, {target_rad}, 1000);
    if (outcome.fallback < 0) continue;
    ++fallen;
    EXPECT_NEAR(outcome.fallback_step_Nm, 0.0, 1e-9) << target_rad;
  }
  EXPECT_GT(fallen, 0);
}

TEST(Chatter, IsNotSeenOnASoundRigidJointHoweverItIsDeclared) {
  Draw draw(41);
  for (const bool rigid : {false, true})
    for (int trial = 0; trial < 20; ++trial) {
      const Outcome outcome =
          run({}, table_for(0.089), rigid, {draw.between(-1.5, 1.5), draw.between(-1.5, 1.5), 0.0}, 1500);
      EXPECT_LT(outcome.fallback, 0) << rigid << ", " << trial;
    }
}

TEST(Chatter, IsNotSeenInAStreamOfSetpoints) {
  for (const bool rigid : {false, true})
    for (const int packet_periods : {1, 4, 10, 20}) {
      std::vector<double> targets;
      for (int k = 0; k * packet_periods < 4000; ++k)
        targets.push_back(0.4 * std::sin(3e-3 * packet_periods * k));
      const Outcome outcome = run({}, table_for(0.089), rigid, targets, packet_periods);
      EXPECT_LT(outcome.fallback, 0) << rigid << ", a packet every " << packet_periods << " ms";
    }
}

TEST(Chatter, IsNotSeenWhereFrictionAndInertiaAreThirtyPerCentOff) {
  for (const double friction : {0.7, 1.3})
    for (const double inertia : {0.8, 1.2}) {
      TwoMassData data;
      data.static_Nm *= friction;
      data.coulomb_Nm *= friction;
      data.viscous_Nms_rad *= friction;
      data.motor_kgm2 *= inertia;
      for (const bool rigid : {false, true}) {
        const Outcome outcome = run(data, table_for(0.089), rigid, {0.001, 0.011, 0.111, 1.0, -0.5}, 1500);
        EXPECT_LT(outcome.fallback, 0) << friction << ", " << inertia << ", " << rigid;
      }
    }
}

}  // namespace
}  // namespace strainwave::testing
