// SPDX-License-Identifier: BSD-3-Clause
// The torque of a streamed sine, period by period, against what the sine itself asks of the simulated joint: its exact inverse dynamics, with
// the true friction, which changes its sign within the period in which the motor turns round. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
  const double link_kgm2 = plant.effects.transmission->link_inertia_kgm2;
  const double motor_share =
      1.0 - link_kgm2 * squared / plant.effects.transmission->spring.stiffness_1_Nm_rad;
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
  JointBench bench({flexible_joint()});
  bench.bring_to_hold(0, flexible_table());
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

/// Judges one stream on a spring.
void expect_torque_of(const TurnStream& stream) {
  const auto what = ::testing::Message()
                    << stream.amplitude_rad << " rad, " << stream.rate_Hz << " Hz, every " << stream.every
                    << " ms, " << stream.derivatives << " derivatives";
  const TurnTorques torques = torques_of(stream);
  double largest_Nm = 0.0, squares = 0.0;
  for (std::size_t k = 3; k + 3 < torques.given_Nm.size(); ++k) {
    largest_Nm = std::max(largest_Nm, std::abs(unasked_Nm(torques, k, 1)));
    squares += std::pow(torques.given_Nm[k] - torques.asked_Nm[k], 2);
  }
  EXPECT_LT(largest_Nm, 1.0) << what;
  // What friction is beside the table's, and what is learned of it, stays: 0.2 to 0.4 N.m rms.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(torques.given_Nm.size())), 0.5) << what;
}

TEST(TurnTorque, IsTheSinesOwnAtEveryRateOfSamples) {
  for (const int every : {50, 20, 10, 5, 3, 2})
    for (const int derivatives : {0, 1}) expect_torque_of({.every = every, .derivatives = derivatives});
  expect_torque_of({.every = 20, .ahead = 30});
}

TEST(TurnTorque, IsTheSinesOwnAtEveryAmplitudeAndRate) {
  for (const double amplitude_rad : {0.01, 0.03, 0.1, 0.3, 1.0})
    for (const double rate_Hz : {0.1, 0.3, 1.0, 2.0}) {
      const TurnStream stream{
          .derivatives = 1, .ahead = 30, .amplitude_rad = amplitude_rad, .rate_Hz = rate_Hz};
      const double omega = stream.omega_rad_s();
      if (amplitude_rad * omega > 5.0 || amplitude_rad * omega * omega > 60.0) continue;
      expect_torque_of(stream);
    }
}

}  // namespace
}  // namespace strainwave::testing
