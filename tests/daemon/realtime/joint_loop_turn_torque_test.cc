// SPDX-License-Identifier: BSD-3-Clause
// The torque of a streamed sine, period by period, against what the sine itself asks of the simulated joint: its exact inverse dynamics, with
// the true friction, which changes its sign within the period in which the motor turns round. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "sim/joint/reference_plant.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kTurnPeriod_s = 1e-3;
constexpr int kTurnBegin = 1000;
constexpr int kTurnEnd = 7000;
// The command of a cycle acts a period after it was given, for a period.
constexpr int kActsAfter = 1;

struct TurnStream {
  int every = 10;  ///< periods
  int derivatives = 0;
  int ahead = 0;  ///< periods that it is stamped ahead; 0: no stamp
  bool flexible = false;
  double temperature_C = 20.0;
  double friction = 1.0;  ///< of the table's
  double amplitude_rad = 0.5;
  double rate_Hz = 0.5;
  double lag() const { return ahead == 0 ? 30 : 0; }  ///< JointControllerConfig::stream_delay_s, in periods
  double omega_rad_s() const { return 2.0 * std::numbers::pi * rate_Hz; }
};

/// Mean over the period that begins at `begin_s` of what the sine of the link asks of the motor. The spring's wind-up stays on its first slope:
/// the motor's sine is the link's, smaller by Jl w^2 / K1.
double asked_Nm(const JointPlantConfig& plant, double temperature_C, const TurnStream& stream,
                double begin_s) {
  constexpr int kParts = 200;
  const double omega = stream.omega_rad_s();
  const double squared = omega * omega;
  double link_kgm2 = 0.0;
  double motor_share = 1.0;
  if (plant.effects.transmission) {
    link_kgm2 = plant.effects.transmission->link_inertia_kgm2;
    motor_share = 1.0 - link_kgm2 * squared / plant.effects.transmission->spring.stiffness_1_Nm_rad;
  }
  const FrictionParameters friction = plant.joint.friction.at(temperature_C);
  double sum_Nm = 0.0;
  for (int part = 0; part < kParts; ++part) {
    const double phase = omega * (begin_s + kTurnPeriod_s * (part + 0.5) / kParts);
    const double link_rad_s2 = -stream.amplitude_rad * squared * std::sin(phase);
    const double motor_rad_s = motor_share * stream.amplitude_rad * omega * std::cos(phase);
    sum_Nm += (plant.joint.inertia_kgm2 * motor_share + link_kgm2) * link_rad_s2 +
              stribeck_friction_Nm(friction, plant.joint.stribeck, motor_rad_s);
  }
  return sum_Nm / kParts;
}

Order turn_sample(const TurnStream& stream, std::int64_t cycle, std::int64_t period) {
  const double phase = stream.omega_rad_s() * kTurnPeriod_s * static_cast<double>(period + stream.ahead);
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.stream_id = 1;
  order.begins_stream = order.approaches = period == 0;
  order.valid_for_s = 0.2;
  order.position_rad = stream.amplitude_rad * std::sin(phase);
  order.derivatives = stream.derivatives;
  if (stream.derivatives > 0)
    order.velocity_rad_s = stream.amplitude_rad * stream.omega_rad_s() * std::cos(phase);
  if (stream.ahead > 0)
    order.at_cycle = cycle + stream.ahead;
  else
    order.sent_us = 1'700'000'000'000'000 + 1000 * period;
  return order;
}

struct TurnTorques {
  std::vector<double> given_Nm;
  std::vector<double> asked_Nm;
};

TurnTorques torques_of(const TurnStream& stream) {
  BenchJoint joint = stream.flexible ? flexible_joint() : demo_joint_with_friction(stream.friction);
  joint.drive.ambient = TemperatureProfile::constant(stream.temperature_C);
  JointBench bench({joint});
  bench.bring_to_hold(0, stream.flexible ? flexible_table() : demo_table());
  TurnTorques torques;
  for (int k = 0; k < kTurnEnd; ++k) {
    if (k % stream.every == 0) {
      EXPECT_TRUE(bench.joint(0).orders().push(turn_sample(stream, bench.cycle() + 1, k)));
    }
    bench.step();
    if (k < kTurnBegin) continue;
    const JointPlant& plant = bench.drive(0).simulated().plant();
    torques.given_Nm.push_back(bench.state(0).torque_commanded_Nm);
    torques.asked_Nm.push_back(asked_Nm(plant.config(), plant.joint_temperature_C(), stream,
                                        kTurnPeriod_s * (k + kActsAfter - stream.lag())));
  }
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  return torques;
}

/// What a step is beyond those that the sine asks for in the same period, or up to `apart` periods before or after it.
double unasked_Nm(const TurnTorques& torques, std::size_t k, std::size_t apart) {
  double least_Nm = 0.0, most_Nm = 0.0;
  for (std::size_t i = k - apart; i <= k + apart; ++i) {
    const double step_Nm = torques.asked_Nm[i] - torques.asked_Nm[i - 1];
    least_Nm += std::min(0.0, step_Nm);
    most_Nm += std::max(0.0, step_Nm);
  }
  const double given_Nm = torques.given_Nm[k] - torques.given_Nm[k - 1];
  return given_Nm - std::clamp(given_Nm, least_Nm, most_Nm);
}

struct Beyond {
  double largest_Nm = 0.0;  ///< within a period of what is asked
  double rms_Nm = 0.0;      ///< beside what is asked
  int periods = 0;          ///< with more than a newton metre
  int turns = 0;
};

void add(const TurnStream& stream, Beyond& all) {
  const TurnTorques torques = torques_of(stream);
  double asked_step_Nm = 0.0, given_step_Nm = 0.0, largest_Nm = 0.0, squares = 0.0;
  for (std::size_t k = 3; k + 3 < torques.given_Nm.size(); ++k) {
    const double asked_Nm = torques.asked_Nm[k] - torques.asked_Nm[k - 1];
    const double beyond_Nm = std::abs(unasked_Nm(torques, k, 1));
    asked_step_Nm = std::max(asked_step_Nm, std::abs(asked_Nm));
    given_step_Nm = std::max(given_step_Nm, std::abs(torques.given_Nm[k] - torques.given_Nm[k - 1]));
    largest_Nm = std::max(largest_Nm, beyond_Nm);
    all.periods += beyond_Nm > 1.0 ? 1 : 0;
    squares += std::pow(torques.given_Nm[k] - torques.asked_Nm[k], 2);
  }
  const double rms_Nm = std::sqrt(squares / static_cast<double>(torques.given_Nm.size()));
  all.rms_Nm = std::max(all.rms_Nm, rms_Nm);
  all.turns += (kTurnEnd - kTurnBegin) / 1000;
  all.largest_Nm = std::max(all.largest_Nm, largest_Nm);
  std::printf(
      "%g rad, %g Hz, %3d samples/s, %d derivatives, %2d ahead, %s: largest step %.2f N.m, asked for %.2f; "
      "beyond "
      "what is asked for %.2f, rms %.3f\n",
      stream.amplitude_rad, stream.rate_Hz, 1000 / stream.every, stream.derivatives, stream.ahead,
      stream.flexible ? "spring" : "rigid ", given_step_Nm, asked_step_Nm, largest_Nm, rms_Nm);
}

Beyond beyond_what_is_asked(bool flexible, double temperature_C, double friction = 1.0) {
  Beyond all;
  for (TurnStream stream :
       {TurnStream{50, 0}, TurnStream{50, 1}, TurnStream{20, 0}, TurnStream{20, 1}, TurnStream{10, 0},
        TurnStream{10, 1}, TurnStream{5, 0}, TurnStream{5, 1}, TurnStream{3, 0}, TurnStream{3, 1},
        TurnStream{2, 0}, TurnStream{2, 1}, TurnStream{10, 1, 30}, TurnStream{20, 0, 30}}) {
    stream.flexible = flexible;
    stream.temperature_C = temperature_C;
    stream.friction = friction;
    add(stream, all);
  }
  std::printf("%s, %g degC, friction %.2f: %d turns, %d periods beyond 1 N.m, at most %.2f N.m\n",
              flexible ? "spring" : "rigid", temperature_C, friction, all.turns, all.periods, all.largest_Nm);
  return all;
}

TEST(TurnTorque, OfAJointThatIsToldOfItsSpringStepsNowhereByANewtonMetreMoreThanTheSineAsksFor) {
  EXPECT_LT(beyond_what_is_asked(true, 20.0).largest_Nm, 1.0);
}

// What friction is beside the table's, and what is learned of it, stays: 0.2 to 0.4 N.m rms.
TEST(TurnTorque, OfAJointOnASpringIsTheSinesOwnAtEveryAmplitudeAndRate) {
  for (const double amplitude_rad : {0.01, 0.03, 0.1, 0.3, 1.0})
    for (const double rate_Hz : {0.1, 0.3, 1.0, 2.0}) {
      TurnStream stream{.derivatives = 1, .ahead = 30, .flexible = true};
      stream.amplitude_rad = amplitude_rad;
      stream.rate_Hz = rate_Hz;
      const double omega = stream.omega_rad_s();
      if (amplitude_rad * omega > 5.0 || amplitude_rad * omega * omega > 60.0) continue;
      Beyond all;
      add(stream, all);
      EXPECT_LT(all.largest_Nm, 1.0) << amplitude_rad << " rad, " << rate_Hz << " Hz";
      EXPECT_LT(all.rms_Nm, 0.5) << amplitude_rad << " rad, " << rate_Hz << " Hz";
    }
}

}  // namespace
}  // namespace strainwave::testing
