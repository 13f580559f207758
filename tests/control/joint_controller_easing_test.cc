// Moves of a joint on which a spring may hang that nobody told of: eased where they begin at rest, and only there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "control/joint_controller.h"
#include "tests/support/scaled_table.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kAcceleration_rad_s2 = 60.0;
// In a period, of a motion that turns from one limit to the other over twenty.
constexpr double kMostChange_rad_s2 = 2.0 * kAcceleration_rad_s2 / 20;

JointControllerConfig config_for(bool rigid) {
  JointControllerConfig config;
  config.encoder_resolution_rad = 2e-5;
  config.torque_limit_Nm = 34.0;
  config.motor = {34.0, 150.0, 18.3};
  config.motion = {5.0, kAcceleration_rad_s2, kAcceleration_rad_s2};
  config.rigid = rigid;
  return config;
}

/// A joint that is where its reference is.
class Followed {
 public:
  explicit Followed(const JointControllerConfig& config) : controller_(config) {
    controller_.load(testing::scaled_table("c4.json", 0.089));
    controller_.start(0.0);
  }
  JointController& controller() { return controller_; }
  Reference step() {
    JointMeasurement measurement;
    measurement.joint_position_rad = last_.position_rad;
    measurement.temperature_C = 20.0;
    measurement.temperature_valid = true;
    last_ = controller_.step(measurement).reference;
    return last_;
  }
  /// The largest change of the acceleration in a period.
  double largest_change_rad_s2(int periods) {
    double largest = 0.0;
    double before = last_.acceleration_rad_s2;
    for (int k = 0; k < periods; ++k) {
      const double now = step().acceleration_rad_s2;
      largest = std::max(largest, std::abs(now - before));
      before = now;
    }
    return largest;
  }

 private:
  JointController controller_;
  Reference last_;
};

TEST(EasedMove, AcceleratesOverTwentyPeriodsAndArrivesExactly) {
  Followed eased(config_for(false));
  eased.controller().set_target(0.3);
  EXPECT_LE(eased.largest_change_rad_s2(1000), kMostChange_rad_s2 + 1e-6);
  EXPECT_EQ(eased.step().position_rad, 0.3);
  eased.controller().set_target(-0.2);
  EXPECT_LE(eased.largest_change_rad_s2(40), kMostChange_rad_s2 + 1e-6);
  // Stops and new targets on the way go on eased.
  eased.controller().set_target(0.4);
  EXPECT_LE(eased.largest_change_rad_s2(90), kMostChange_rad_s2 + 1e-6);
  eased.controller().stop();
  EXPECT_LE(eased.largest_change_rad_s2(500), kMostChange_rad_s2 + 1e-6);
}

TEST(EasedMove, IsNoneOfAJointThatIsDeclaredRigidNorWhereAJerkLimitIsGiven) {
  Followed rigid(config_for(true));
  rigid.controller().set_target(0.3);
  EXPECT_GT(rigid.largest_change_rad_s2(50), 0.5 * kAcceleration_rad_s2);
  JointControllerConfig config = config_for(false);
  config.jerk_limit_rad_s3 = 12000.0;  // 10 ms
  Followed limited(config);
  limited.controller().set_target(0.3);
  EXPECT_NEAR(limited.largest_change_rad_s2(1000), 12.0, 0.5);
}

// A stream takes over where the reference is, without a jump and without a step of the acceleration, and what follows it from rest is eased
// again.
TEST(EasedMove, IsTakenOverByAStreamWithoutAJumpAndEasedAgainAfterIt) {
  Followed joint(config_for(false));
  joint.controller().set_target(1.0);
  Reference before;
  for (int k = 0; k < 60; ++k) before = joint.step();
  const double from_rad = before.position_rad;
  for (int k = 0; k < 300; ++k) {
    StreamSample sample;
    sample.position_rad = from_rad + 0.5 * kPeriod_s * k;
    sample.velocity_rad_s = 0.5;
    sample.derivatives = 1;
    joint.controller().follow(sample, k == 0, 0.0, {});
    const Reference now = joint.step();
    EXPECT_NEAR(now.position_rad,
                before.position_rad +
                    kPeriod_s * (before.velocity_rad_s + 0.5 * kPeriod_s * before.acceleration_rad_s2),
                1e-9 + kPeriod_s * kPeriod_s * kMostChange_rad_s2 / 12.0)
        << k << ": within a period the acceleration of a mean rises evenly, by so much at most";
    EXPECT_NEAR(now.velocity_rad_s, before.velocity_rad_s + kPeriod_s * before.acceleration_rad_s2, 1e-9)
        << k;
    EXPECT_LE(std::abs(now.acceleration_rad_s2 - before.acceleration_rad_s2), kMostChange_rad_s2 + 1e-6) << k;
    before = now;
  }
  EXPECT_NEAR(before.position_rad, from_rad + 0.5 * kPeriod_s * 299, 1e-6) << "and is on time";
  for (int k = 0; k < 1000; ++k) joint.step();
  joint.controller().set_target(0.0);
  EXPECT_LE(joint.largest_change_rad_s2(1000), kMostChange_rad_s2 + 1e-6);
  EXPECT_EQ(joint.step().position_rad, 0.0);
}

// What goes on eased is no later than what is not.
TEST(EasedMove, LetsAStreamThatTakesItOverBeOnTime) {
  constexpr double kRate_rad_s = 3.141592653589793;
  Followed joint(config_for(false));
  joint.controller().set_target(1.0);
  const double from_rad = [&joint] {
    for (int k = 0; k < 59; ++k) joint.step();
    return joint.step().position_rad;
  }();
  double sum_rad2 = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double at_rad = kRate_rad_s * kPeriod_s * k;
    StreamSample sample;
    sample.position_rad = from_rad + 0.5 * std::sin(at_rad);
    sample.velocity_rad_s = 0.5 * kRate_rad_s * std::cos(at_rad);
    sample.derivatives = 1;
    if (k % 10 == 0) joint.controller().follow(sample, k == 0, 0.0, {});
    const double off_rad = joint.step().position_rad - sample.position_rad;
    if (k >= 1000) sum_rad2 += off_rad * off_rad;
  }
  EXPECT_LT(std::sqrt(sum_rad2 / 2000), 1e-3);
}

}  // namespace
}  // namespace strainwave
