// The controller that is told of the gear's spring, where what it is told is wrong by much, and where a motion is long.
// The joint is tests/support/catalogue_joint.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "control/joint_controller.h"
#include "tests/support/catalogue_joint.h"
#include "tests/support/scaled_table.h"

namespace strainwave {
namespace {

using testing::kMotor_kgm2;

constexpr double kCount_rad = 2.0 * std::numbers::pi / 320000.0;

struct Case {
  double link_kgm2 = 0.1;
  double told_load = 1.0;  ///< times the link that the joint has
  double temperature_C = 20.0;
  double target_rad = 0.1;
  bool told_of_spring = true;
  int delay_periods = 1;  ///< told as 1
  bool encoder_on_link = false;
  double friction = 1.0;  ///< times what the table has
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.told_of_spring ? "told, link " : "by default, link ") << c.link_kgm2
             << " kgm2, load told times " << c.told_load << ", " << c.temperature_C << " degC, "
             << c.target_rad << " rad, delay " << c.delay_periods << ", friction " << c.friction
             << (c.encoder_on_link ? ", encoder on the link" : "");
}

TwoMassData joint_of(const Case& c) {
  TwoMassData data = testing::catalogue_joint(c.temperature_C, c.link_kgm2, 0.01, c.delay_periods);
  data.encoder_on_link = c.encoder_on_link;
  for (double* part : {&data.static_Nm, &data.coulomb_Nm, &data.viscous_Nms_rad}) *part *= c.friction;
  return data;
}

JointControllerConfig config_of(const Case& c) {
  JointControllerConfig config;
  config.encoder_resolution_rad = kCount_rad;
  config.delay_periods = 1;
  config.torque_limit_Nm = testing::kPeak_Nm;
  config.motor = {testing::kPeak_Nm, testing::kStall_Nm, testing::kTorquePerSpeed_Nms_rad};
  config.motion = {1e3, 1e6, 1e6};
  const double link_kgm2 = c.told_load * c.link_kgm2;
  if (c.told_of_spring)
    config.link = {kMotor_kgm2,
                   link_kgm2,
                   {8100.0, 3.9, 11000.0, 12.0, 13000.0},
                   testing::damping_Nms_rad(link_kgm2, 0.03),
                   {}};
  return config;
}

struct Outcome {
  int first_motion = -1;  ///< periods
  int fallback = -1;
  int off = -1;
  int late_reversals =
      0;  ///< of the torque between 2.5 of static friction, later than 0.5 s after the first motion
  double overshoot_rad = 0.0;
  double thrown_rad = 0.0;        ///< how far the motor goes in 60 periods from the fallback
  int corrections = 0;            ///< before the fallback
  double fallback_step_Nm = 0.0;  ///< of the torque, in the period that begins with the law alone
};

/// Runs as the daemon would: a joint that is switched off gets no torque.
Outcome run(const Case& c, int periods = 2000) {
  TwoMassJoint joint(joint_of(c));
  JointController controller(config_of(c));
  controller.load(testing::scaled_table("total-1.089/c4.json", kMotor_kgm2 + c.told_load * c.link_kgm2));
  controller.start(joint.reading_rad());
  controller.set_target(c.target_rad);
  const double strong_Nm = 2.5 * joint_of(c).static_Nm;
  Outcome outcome;
  double side = 0.0;
  double fallback_rad = 0.0;
  double last_Nm = 0.0;
  for (int now = 0; now < periods; ++now) {
    JointMeasurement measurement;
    measurement.joint_position_rad = joint.reading_rad();
    measurement.temperature_C = c.temperature_C;
    measurement.temperature_valid = true;
    const JointStep step = controller.step(measurement);
    if (outcome.fallback < 0) {
      outcome.corrections = step.replans;
      fallback_rad = joint.motor_rad();
      if (step.monitor != MonitorState::kWatching) outcome.fallback = now;
    } else if (now < outcome.fallback + 60) {
      outcome.thrown_rad = std::max(outcome.thrown_rad, std::abs(joint.motor_rad() - fallback_rad));
    }
    if (now == outcome.fallback + 1 && outcome.fallback >= 0)
      outcome.fallback_step_Nm = step.output.torque_Nm - last_Nm;
    last_Nm = step.output.torque_Nm;
    if (step.monitor == MonitorState::kFaultDue) {
      outcome.off = now;
      break;
    }
    const double torque_Nm = step.output.torque_Nm;
    if (std::abs(torque_Nm) > strong_Nm) {
      if (side * torque_Nm < 0.0 && now > outcome.first_motion + 500) ++outcome.late_reversals;
      side = torque_Nm;
    }
    joint.step(torque_Nm);
    if (joint.moves() && outcome.first_motion < 0) outcome.first_motion = now;
    outcome.overshoot_rad = std::max(outcome.overshoot_rad, joint.link_rad() - c.target_rad);
  }
  return outcome;
}

TEST(ToldOfItsSpring, WithALoadFourToThirtyTimesWrongReversesNoMoreThanHalfASecond) {
  int distrusted = 0;
  for (const double link : {0.03, 0.1, 0.267, 1.0})
    for (const double told : {1.0 / 30.0, 0.1, 0.25, 4.0, 10.0, 30.0})
      for (const double temperature : {-10.0, 20.0, 45.0})
        for (const double target : {0.01, 0.1, 1.0}) {
          const Case c{
              .link_kgm2 = link, .told_load = told, .temperature_C = temperature, .target_rad = target};
          const Outcome outcome = run(c);
          // A motion of 1 rad with half of the torque brakes later than that; a heavy link then overshoots, and turns round.
          const int allowed = target < 1.0 ? 0 : link < 0.5 ? 1 : 4;
          EXPECT_LE(outcome.late_reversals, allowed)
              << c << ", fallback " << outcome.fallback << ", off " << outcome.off;
          if (outcome.fallback >= 0) ++distrusted;
        }
  EXPECT_GT(distrusted, 80);
}

TEST(ToldOfItsSpring, WithTheEncoderOnTheLinkReversesNoMoreThanHalfASecond) {
  for (const double link : {0.03, 0.1, 0.267})
    for (const double temperature : {-10.0, 20.0, 45.0})
      for (const double target : {0.001, 0.01, 0.1, 1.0}) {
        const Case c{
            .link_kgm2 = link, .temperature_C = temperature, .target_rad = target, .encoder_on_link = true};
        EXPECT_EQ(run(c).late_reversals, 0) << c;
      }
}

TEST(ToldOfItsSpring, WithTwiceTheDelayRestsOnTheFallbackAndIsSwitchedOffOnlyWithALinkThatIsTooHeavy) {
  int fallen_back = 0;
  for (const double link : {0.03, 0.06, 0.1, 0.2, 0.267, 1.0})
    for (const double temperature : {-10.0, 0.0, 20.0, 45.0})
      for (const double target : {0.001, 0.01, 0.1, 1.0}) {
        const Case c{
            .link_kgm2 = link, .temperature_C = temperature, .target_rad = target, .delay_periods = 2};
        const Outcome outcome = run(c);
        // A heavy link that overshoots a motion of 1 rad turns round later than that.
        EXPECT_LE(outcome.late_reversals, link > 0.5 && target == 1.0 ? 1 : 0) << c;
        if (outcome.fallback >= 0) ++fallen_back;
        if (link < 0.5) {
          EXPECT_LT(outcome.off, 0) << c;
        }
      }
  EXPECT_GT(fallen_back, 10);
}

TEST(ToldOfItsSpring, ALongMoveDoesNotOutrunTheMotorThatMustBrakeIt) {
  for (const bool told : {true, false})
    for (const double link : {0.03, 0.1, 0.267})
      for (const double temperature : {-10.0, 20.0, 45.0})
        for (const double target : {2.0, 3.0, 4.0, 6.0}) {
          const Case c{
              .link_kgm2 = link, .temperature_C = temperature, .target_rad = target, .told_of_spring = told};
          const Outcome outcome = run(c);
          EXPECT_LE(outcome.overshoot_rad, told ? 1.5e-3 : 7e-3) << c;
          EXPECT_LT(outcome.fallback, 0) << c;
        }
}

// Less friction than told: what breaks the joint away as told would throw it.
TEST(ToldOfItsSpring, AFallbackFromACorrectionThrowsNoJointAndMakesNoStep) {
  for (const Case& c :
       {Case{.link_kgm2 = 0.06, .told_load = 0.5, .temperature_C = 45.0, .delay_periods = 3, .friction = 0.1},
        Case{.temperature_C = 20.0, .delay_periods = 3, .friction = 0.05},
        Case{.temperature_C = 45.0, .delay_periods = 3, .friction = 0.3}}) {
    const Outcome outcome = run(c);
    ASSERT_GE(outcome.fallback, 0) << c;
    ASSERT_GT(outcome.corrections, 0) << c << ": no correction, and nothing shown";
    EXPECT_LE(std::abs(outcome.fallback_step_Nm), 0.01) << c;
    EXPECT_LE(outcome.thrown_rad, 8.5e-3) << c;
  }
}

TEST(ToldOfItsSpring, NoFallbackOfFourHundredRandomJointsMakesATorqueStepOrThrowsOneThatWasToRest) {
  std::mt19937_64 random(20);
  const auto in_proportion = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>()(random));
  };
  int fallen_back = 0;
  int corrected = 0;
  for (int k = 0; k < 400; ++k) {
    Case c;
    c.link_kgm2 = in_proportion(0.03, 0.3);
    c.told_load = in_proportion(0.25, 4.0);
    c.temperature_C = std::uniform_real_distribution<double>(-10.0, 40.0)(random);
    c.target_rad = in_proportion(1e-3, 1.0);
    c.delay_periods = static_cast<int>(random() % 3) + 1;
    c.friction = in_proportion(0.1, 1.5);
    const Outcome outcome = run(c, 1000);
    if (outcome.fallback < 0 || outcome.fallback == outcome.off) continue;
    ++fallen_back;
    if (outcome.corrections > 0) ++corrected;
    EXPECT_LE(std::abs(outcome.fallback_step_Nm), 1.0) << c << ", at " << outcome.fallback;
    if (outcome.corrections > 0) {
      EXPECT_LE(outcome.thrown_rad, 15e-3) << c << ", at " << outcome.fallback;
    }
  }
  EXPECT_GT(fallen_back, 60);
  EXPECT_GT(corrected, 2);
}

/// A motor that stands still behind an encoder that shows `reading_rad`, after an order to `target_rad` has been carried out.
int corrections_at_rest(double target_rad, const std::function<double(int)>& reading_rad, int periods) {
  JointController controller(config_of({}));
  controller.load(testing::scaled_table("total-1.089/c4.json", 0.189));
  controller.start(target_rad);
  controller.set_target(target_rad);
  JointMeasurement measurement;
  measurement.temperature_C = 20.0;
  measurement.temperature_valid = true;
  int corrections = 0;
  for (int k = 0; k < periods; ++k) {
    measurement.joint_position_rad = reading_rad(k);
    corrections = controller.step(measurement).replans;
  }
  return corrections;
}

TEST(ToldOfItsSpring, OneFlickeringCountAtRestMakesNoCorrectionAndAnErrorThatStaysDoes) {
  std::mt19937_64 random(7);
  const auto flickering = [&](int) { return (random() % 2 == 0 ? 1.0 : 2.0) * kCount_rad; };
  EXPECT_EQ(corrections_at_rest(0.0, flickering, 20000), 0);
  const auto slow = [](int k) { return (k / 10 % 2 == 0 ? 1.0 : 2.0) * kCount_rad; };
  EXPECT_EQ(corrections_at_rest(0.0, slow, 2000), 0);
  EXPECT_GT(corrections_at_rest(
                0.0, [](int) { return 2.0 * kCount_rad; }, 100),
            0);
  EXPECT_GT(corrections_at_rest(
                0.0, [](int) { return 6.0 * kCount_rad; }, 10),
            0);
}

}  // namespace
}  // namespace strainwave
