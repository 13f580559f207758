// SPDX-License-Identifier: BSD-3-Clause
#include "control/scheduled_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

const GainTable& table() {
  static const GainTable shipped = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/c4.json");
  return shipped;
}

ScheduledController scheduled() {
  return {table().primary, table().friction, table().plant};
}

ControllerInput input_at(double error_rad, double velocity_rad_s, double limit_Nm = 34.0) {
  ControllerInput input;
  input.joint_position_rad = error_rad;
  input.joint_velocity_rad_s = velocity_rad_s;
  input.torque_limit_Nm = limit_Nm;
  return input;
}

/// V of the state that the last step(input) used. Since then the integral has grown by one sample.
double lyapunov_used(const ScheduledController& controller, const ControllerInput& input) {
  const double error_rad = input.joint_position_rad - input.setpoint_position_rad;
  const StateVector x{controller.integral_rad_s() - table().plant.period_s * error_rad, error_rad,
                      input.joint_velocity_rad_s - input.setpoint_velocity_rad_s};
  return x.dot(table().primary.lyapunov(0) * x);
}

TEST(ScheduledController, TheTorqueIsOddInTheState) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> error(-0.05, 0.05);
  std::uniform_real_distribution<double> velocity(-2.0, 2.0);
  for (int trial = 0; trial < 500; ++trial) {
    const double e = error(random);
    const double w = velocity(random);
    ScheduledController one = scheduled();
    ScheduledController other = scheduled();
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(one.step(input_at(e, w)).torque_Nm, -other.step(input_at(-e, -w)).torque_Nm);
  }
}

TEST(ScheduledController, NeverExceedsTheTorqueThatIsLeft) {
  ScheduledController controller = scheduled();
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  for (int trial = 0; trial < 2000; ++trial) {
    ControllerInput input =
        input_at(std::pow(10.0, exponent(random)), -std::pow(10.0, exponent(random)), 20.0);
    if (trial % 2 == 0) input.joint_position_rad = -input.joint_position_rad;
    input.torque_min_Nm = -7.0;
    const double torque_Nm = controller.step(input).torque_Nm;
    EXPECT_GE(torque_Nm, -7.0);
    EXPECT_LE(torque_Nm, 20.0);
  }
}

TEST(ScheduledController, AntiWindupNeverRaisesTheLyapunovFunctionHoweverLongTheTorqueIsSaturated) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> error(-1.0, 1.0);
  std::uniform_real_distribution<double> velocity(-5.0, 5.0);
  int saturated = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ScheduledController controller = scheduled();
    const ControllerInput input = input_at(error(random), velocity(random), 0.5);
    if (!controller.step(input).saturated) continue;
    ++saturated;
    const double first = lyapunov_used(controller, input);
    for (int k = 0; k < 500; ++k) {
      controller.step(input);
      ASSERT_LE(lyapunov_used(controller, input), first * (1.0 + 1e-9)) << trial << ", " << k;
    }
  }
  EXPECT_GT(saturated, 200);
}

TEST(ScheduledController, ANewSetpointDoesNotRaiseTheSlowPartOfTheLyapunovFunction) {
  const StateMatrix P = table().primary.lyapunov(0);
  ScheduledController controller = scheduled();
  for (int k = 0; k < 50; ++k) controller.step(input_at(1e-3, 0.0));
  const auto slow = [&](double integral, double e, double w) {
    return integral + (P(0, 1) * e + P(0, 2) * w) / P(0, 0);
  };
  const double before = slow(controller.integral_rad_s(), 1e-3, 0.0);
  ControllerInput jumped = input_at(1e-3, 0.0);
  jumped.setpoint_position_rad = -0.7;
  jumped.jumped_from_rad = 0.0;
  controller.step(jumped);
  const double used = controller.integral_rad_s() - table().plant.period_s * 0.701;
  EXPECT_NEAR(slow(used, 0.701, 0.0), before, 1e-12);
}

TEST(ScheduledController, ATemperatureChangeMovesTheTorqueByNoMoreThanFrictionAndGainsDiffer) {
  ScheduledController controller = scheduled();
  const ControllerInput input = input_at(0.0, 0.0);
  for (double temperature_C = -20.0; temperature_C < 60.0; temperature_C += 0.1) {
    controller.set_temperature(temperature_C);
    EXPECT_EQ(controller.step(input).torque_Nm, 0.0) << "at rest on the setpoint, at " << temperature_C;
  }
}

TEST(ScheduledController, AMotionGetsItsTorque) {
  ScheduledController controller = scheduled();
  ControllerInput input = input_at(0.0, 1.0);
  input.setpoint_velocity_rad_s = 1.0;
  input.feedforward_torque_Nm = 12.5;
  const ControllerOutput output = controller.step(input);
  EXPECT_DOUBLE_EQ(output.torque_Nm, 12.5);
  EXPECT_DOUBLE_EQ(output.feedforward_torque_Nm, 12.5);
}

ControllerInput input_over(double error_rad, double velocity_rad_s, int elapsed_periods = 1) {
  ControllerInput input = input_at(error_rad, velocity_rad_s, 1e3);
  input.elapsed_periods = elapsed_periods;
  return input;
}

ScheduledController leading(double lead_periods) {
  return {table().primary, table().friction, table().plant, lead_periods};
}

TEST(ScheduledController, ALeadAddsWhatTheLawHasChangedByInSoManyPeriods) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> error(-3e-3, 3e-3);
  std::uniform_real_distribution<double> velocity(-0.5, 0.5);
  std::uniform_int_distribution<int> elapsed(1, 3);
  constexpr double kLead = 2.5;
  ScheduledController law = scheduled();
  ScheduledController led = leading(kLead);
  double last_Nm = 0.0;
  for (int k = 0; k < 300; ++k) {
    const int periods = elapsed(random);
    const ControllerInput input = input_over(error(random), velocity(random), periods);
    // The first sample has no previous one, nor has the first after interrupt() or reset(). There the lead adds nothing.
    const bool anew = k % 50 == 0;
    if (k == 50) led.interrupt();
    if (k >= 100 && anew) {
      law.reset();
      led.reset();
    }
    const double now_Nm = law.step(input).torque_Nm;
    const double change_Nm = anew ? 0.0 : kLead * (now_Nm - last_Nm) / periods;
    const ControllerOutput output = led.step(input);
    ASSERT_NEAR(output.torque_Nm, now_Nm + change_Nm, 1e-9) << k;
    ASSERT_EQ(output.feedback_torque_Nm, output.torque_Nm) << k;
    last_Nm = now_Nm;
  }
}

TEST(ScheduledController, ALeadFollowsNoJumpOfTheSetpoint) {
  ScheduledController led = leading(2.0);
  led.step(input_over(1e-3, 0.0));
  ScheduledController law = leading(0.0);
  law.step(input_over(1e-3, 0.0));
  ControllerInput jumped = input_at(1e-3, 0.0, 1e3);
  jumped.setpoint_position_rad = -0.2;
  jumped.jumped_from_rad = 0.0;
  EXPECT_EQ(led.step(jumped).torque_Nm, law.step(jumped).torque_Nm);
  EXPECT_NE(led.step(input_over(2e-3, 0.0)).torque_Nm, law.step(input_over(2e-3, 0.0)).torque_Nm);
}

// The gain change comes while the law's torque changes. carry_over() must not put the lead's share of the torque into the integral.
TEST(ScheduledController, AGainChangeWithALeadMakesNoTorqueStepAndTheLeadGoesOn) {
  for (const double lead_before : {2.0, 0.0}) {
    ScheduledController outgoing = leading(lead_before);
    for (int k = 0; k < 5; ++k) outgoing.step(input_over(1e-4 * k, 0.02 * k));
    const ControllerInput input = input_over(5e-4, 0.1);
    ScheduledController incoming(testing::shipped_table("c3").primary, table().friction, table().plant, 2.0);
    const std::optional<double> last_law_Nm = outgoing.last_law_Nm();
    const double torque_Nm = outgoing.step(input).torque_Nm;
    incoming.carry_over(input, torque_Nm, last_law_Nm);
    EXPECT_NEAR(incoming.step(input).torque_Nm, torque_Nm, 1e-9);
    const ControllerInput next = input_over(6e-4, 0.12);
    if (lead_before == 0.0) continue;
    EXPECT_NEAR(incoming.step(next).torque_Nm, outgoing.step(next).torque_Nm, 0.3);
  }
}

}  // namespace
}  // namespace strainwave
