#include "control/velocity_observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace strainwave {
namespace {

constexpr double kCount_rad = 2e-5;
constexpr double kPeriod_s = 0.001;

JointModel model() {
  return {0.089, {4.4, 3.6, 2.3}, {0.042, 2.0}, 1.6};
}

VelocityObserver observer() {
  VelocityObserver result({kPeriod_s, kCount_rad, 0.02});
  result.reset(0.0, model().friction_scale_Nm);
  return result;
}

double read(double position_rad) {
  return std::nearbyint(position_rad / kCount_rad) * kCount_rad;
}

/// A joint that is not the model: more friction, another inertia, integrated on its own.
struct Joint {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  void step(double torque_Nm) {
    for (int k = 0; k < 100; ++k) {
      const double sliding_Nm = 4.0 + 2.6 * std::abs(velocity_rad_s);
      const double friction_Nm = velocity_rad_s == 0.0
                                     ? std::min(std::abs(torque_Nm), 4.9) * (torque_Nm < 0.0 ? -1.0 : 1.0)
                                     : std::copysign(sliding_Nm, velocity_rad_s);
      const double next = velocity_rad_s + 1e-5 / 0.097 * (torque_Nm - friction_Nm);
      if (velocity_rad_s * next < 0.0)
        velocity_rad_s = 0.0;
      else
        velocity_rad_s = next;
      position_rad += 1e-5 * velocity_rad_s;
    }
  }
};

TEST(VelocityObserver, NeverLeavesByACountTheEdgesBetweenWhichTheEncoderSaysTheJointIs) {
  VelocityObserver filter = observer();
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> torque(-30.0, 30.0);
  double torque_Nm = 0.0;
  for (int k = 0; k < 5000; ++k) {
    if (k % 7 == 0) torque_Nm = k % 350 < 100 ? 0.0 : torque(random);
    const ModelMotion motion = model().advance(torque_Nm, {}, velocity_rad_s, kPeriod_s);
    position_rad += motion.displacement_rad;
    velocity_rad_s = motion.velocity_rad_s;
    filter.predict(torque_Nm, model());
    filter.correct(read(position_rad));
    // Edges are taken for soft: a hard bound would be believed too much.
    const double outside_rad =
        std::abs(filter.estimate().position_rad - read(position_rad)) - 0.5 * kCount_rad;
    ASSERT_LE(outside_rad, kCount_rad) << k;
  }
}

TEST(VelocityObserver, FindsTheVelocityOfAJointThatIsNotItsModel) {
  VelocityObserver filter = observer();
  Joint joint;
  double sum = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double torque_Nm = 12.0 * std::sin(2e-3 * 3.0 * k);
    joint.step(torque_Nm);
    filter.predict(torque_Nm, model());
    filter.correct(read(joint.position_rad));
    if (k >= 500) sum += std::pow(filter.estimate().velocity_rad_s - joint.velocity_rad_s, 2);
  }
  EXPECT_LT(std::sqrt(sum / 1500.0), 0.5 * kCount_rad / kPeriod_s);
}

TEST(VelocityObserver, ShowsExactlyNoVelocityOfAJointThatFrictionHolds) {
  VelocityObserver filter = observer();
  for (int k = 0; k < 1000; ++k) {
    filter.predict(4.3, model());
    filter.correct(0.0);
    EXPECT_EQ(filter.estimate().velocity_rad_s, 0.0);
  }
}

TEST(VelocityObserver, TheSameReadingAgainTeachesAJointAtRestNothing) {
  VelocityObserver filter = observer();
  const double before_rad = filter.estimate().position_deviation_rad;
  for (int k = 0; k < 1000; ++k) {
    filter.predict(0.0, model());
    filter.correct(0.0);
  }
  EXPECT_EQ(filter.estimate().position_deviation_rad, before_rad);
}

TEST(VelocityObserver, IsSurprisedByAPushThatItDoesNotKnowAndNotByItsOwnTorque) {
  VelocityObserver filter = observer();
  Joint joint;
  for (int k = 0; k < 200; ++k) {
    joint.step(15.0);
    filter.predict(15.0, model());
    filter.correct(read(joint.position_rad));
    if (k > 20) {
      EXPECT_FALSE(filter.estimate().surprised) << k;
    }
  }
  filter.predict(15.0, model());
  filter.correct(read(joint.position_rad) + 400.0 * kCount_rad);
  EXPECT_TRUE(filter.estimate().surprised);
}

// A joint that rests, and then reads other counts all at once.
TEST(VelocityObserver, LaysACountInAPlannedMotionToFrictionAndAtRestToALoad) {
  const auto load_Nm = [](SurpriseCause cause, double counts) {
    VelocityObserver filter = observer();
    filter.predict(0.0, model());
    filter.correct(0.0, cause);
    filter.predict(0.0, model());
    filter.correct(counts * kCount_rad, cause);
    EXPECT_TRUE(filter.estimate().surprised) << counts;
    return std::abs(filter.estimate().disturbance.load_Nm);
  };
  EXPECT_LT(load_Nm(SurpriseCause::kFriction, 2.0), 0.6 * load_Nm(SurpriseCause::kLoad, 2.0));
  // What friction cannot do is a load's, whenever it comes.
  EXPECT_NEAR(load_Nm(SurpriseCause::kFriction, 20.0) / load_Nm(SurpriseCause::kLoad, 20.0), 1.0, 0.05);
}

TEST(VelocityObserver, BelievesNothingThatNoJointHas) {
  VelocityObserver filter = observer();
  std::mt19937_64 random(37);
  std::uniform_real_distribution<double> reading(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    filter.predict(34.0 * reading(random), model());
    filter.correct(read(reading(random)));
    const JointEstimate estimate = filter.estimate();
    ASSERT_TRUE(std::isfinite(estimate.position_rad) && std::isfinite(estimate.velocity_rad_s)) << k;
    ASSERT_GE(estimate.inertia_ratio, 0.5);
    ASSERT_LE(estimate.inertia_ratio, 2.5);
    ASSERT_GE(estimate.disturbance.friction_offset_Nm, -0.8 * 4.4);
    ASSERT_LE(std::abs(estimate.disturbance.load_Nm), 20.0 * 4.4);
  }
}

TEST(VelocityObserver, BeginsWithTheVelocityAndTheLoadThatItIsGiven) {
  VelocityObserver filter({kPeriod_s, kCount_rad, 0.02});
  filter.reset(0.3, 1.6, 2.0, -5.0);
  EXPECT_EQ(filter.estimate().velocity_rad_s, 2.0);
  EXPECT_EQ(filter.estimate().disturbance.load_Nm, -5.0);
}

struct UnevenRun {
  int surprises = 0;
  double worst_rad_s = 0.0;  ///< of the velocity, while it moves fast
};

/// A joint that is the model, sampled up to `late_s` late.
UnevenRun run_unevenly(double late_s, double sampling_deviation_s) {
  VelocityObserver filter({kPeriod_s, kCount_rad, 0.02, sampling_deviation_s});
  filter.reset(0.0, model().friction_scale_Nm);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> lateness(0.0, std::max(late_s, 1e-12));
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  UnevenRun result;
  for (int k = 0; k < 3000; ++k) {
    const double torque_Nm = k % 200 < 60 ? 12.0 : k % 200 < 100 ? -5.0 : 0.0;
    const ModelMotion motion = model().advance(torque_Nm, {}, velocity_rad_s, kPeriod_s);
    position_rad += motion.displacement_rad;
    velocity_rad_s = motion.velocity_rad_s;
    filter.predict(torque_Nm, model());
    filter.correct(read(position_rad + lateness(random) * velocity_rad_s));
    const JointEstimate estimate = filter.estimate();
    result.surprises += estimate.surprised ? 1 : 0;
    if (std::abs(velocity_rad_s) > 1.0)
      result.worst_rad_s = std::max(result.worst_rad_s, std::abs(estimate.velocity_rad_s - velocity_rad_s));
  }
  return result;
}

TEST(VelocityObserver, IsNotSurprisedBySamplesThatAreAsUnevenAsItWasTold) {
  EXPECT_EQ(run_unevenly(1e-4, 3e-5).surprises, 0);
  EXPECT_LT(run_unevenly(1e-4, 3e-5).worst_rad_s, 0.05);
  EXPECT_LT(run_unevenly(0.0, 3e-5).worst_rad_s, 0.05);
  EXPECT_GT(run_unevenly(1e-4, 0.0).surprises, 20) << "it is the knowledge that helps";
}

}  // namespace
}  // namespace strainwave
