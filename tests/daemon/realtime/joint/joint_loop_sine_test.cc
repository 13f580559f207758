// SPDX-License-Identifier: BSD-3-Clause
// A streamed sine, period by period: the joint's position, and its torque against the torque that the sine requires of the simulated
// joint. The required torque is the exact inverse dynamics with the true friction, which changes its sign in the period in which the
// motor reverses. For the effects of networks on streams see tests/control/stream_buffer_network_test.cc. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "tests/daemon/realtime/joint/streamed_sine.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kSinePeriod_s = 1e-3;
constexpr int kSineBegin = 1000;
constexpr int kSineEnd = 5000;
// The command of a cycle acts one period later, for one period.
constexpr int kActsAfter = 1;

/// Mean torque that the link's sine requires of the motor in the period that begins at `begin_s`. The spring's
/// wind-up stays on its first slope, so that the motor's sine is smaller than the link's by Jl w^2 / K1.
double asked_Nm(const JointPlantConfig& plant, double temperature_C, const StreamedSine& sine,
                double begin_s) {
  constexpr int kParts = 200;
  const double omega = sine.omega_rad_s();
  const auto& gear = plant.effects.transmission;
  const double link_kgm2 = gear ? gear->link_inertia_kgm2 : 0.0;
  const double motor_share = gear ? 1.0 - link_kgm2 * omega * omega / gear->spring.stiffness_1_Nm_rad : 1.0;
  const FrictionParameters friction = plant.joint.friction.at(temperature_C);
  double sum_Nm = 0.0;
  for (int part = 0; part < kParts; ++part) {
    const double phase = omega * (begin_s + kSinePeriod_s * (part + 0.5) / kParts);
    const double link_rad_s2 = -sine.amplitude_rad * omega * omega * std::sin(phase);
    const double motor_rad_s = motor_share * sine.amplitude_rad * omega * std::cos(phase);
    sum_Nm += (plant.joint.inertia_kgm2 * motor_share + link_kgm2) * link_rad_s2 +
              stribeck_friction_Nm(friction, plant.joint.stribeck, motor_rad_s);
  }
  return sum_Nm / kParts;
}

struct Ride {
  std::vector<double> given_Nm;
  std::vector<double> asked_Nm;
  double rms_error_rad = 0.0;  ///< of the link, from the sine at the allowed lag
  bool off_stream = false;
};

Ride ride(const StreamedSine& sine, bool flexible) {
  JointBench bench({flexible ? flexible_joint(sine.load_kgm2) : demo_joint()});
  bench.bring_to_hold(0, flexible ? flexible_table() : demo_table());
  const JointPlant& plant = bench.drive(0).simulated().plant();
  Ride result;
  for (int k = 0; k < kSineEnd; ++k) {
    if (k % sine.every == 0) {
      EXPECT_TRUE(bench.joint(0).orders().push(sine.sample(bench.cycle() + 1, k)));
    }
    bench.step();
    if (k < kSineBegin) continue;
    const double then_s = kSinePeriod_s * (k - sine.lag());
    result.given_Nm.push_back(bench.state(0).torque_commanded_Nm);
    result.asked_Nm.push_back(
        asked_Nm(plant.config(), plant.joint_temperature_C(), sine, then_s + kActsAfter * kSinePeriod_s));
    const double sine_rad = sine.amplitude_rad * std::sin(sine.omega_rad_s() * then_s);
    result.rms_error_rad += std::pow(plant.link_state().position_rad - sine_rad, 2) / (kSineEnd - kSineBegin);
    result.off_stream = result.off_stream || bench.has_notice(0, Notice::kOffStream);
  }
  result.rms_error_rad = std::sqrt(result.rms_error_rad);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  return result;
}

/// The part of a step that exceeds those required in the same period and in the periods before and after it.
double unasked_Nm(const Ride& torques, std::size_t k) {
  double least_Nm = 0.0, most_Nm = 0.0;
  for (std::size_t i = k - 1; i <= k + 1; ++i) {
    const double step_Nm = torques.asked_Nm[i] - torques.asked_Nm[i - 1];
    least_Nm += std::min(0.0, step_Nm);
    most_Nm += std::max(0.0, step_Nm);
  }
  const double given_Nm = torques.given_Nm[k] - torques.given_Nm[k - 1];
  return given_Nm - std::clamp(given_Nm, least_Nm, most_Nm);
}

void expect_torque_of(const StreamedSine& sine, bool flexible) {
  const auto what = ::testing::Message()
                    << sine.amplitude_rad << " rad, " << sine.rate_Hz << " Hz, every " << sine.every
                    << " ms, " << sine.derivatives << " derivatives, load of " << sine.load_kgm2 << " kg m2";
  const Ride seen = ride(sine, flexible);
  double largest_Nm = 0.0, squares = 0.0;
  for (std::size_t k = 3; k + 3 < seen.given_Nm.size(); ++k) {
    largest_Nm = std::max(largest_Nm, std::abs(unasked_Nm(seen, k)));
    squares += std::pow(seen.given_Nm[k] - seen.asked_Nm[k], 2);
  }
  EXPECT_LT(largest_Nm, 1.0) << what;
  // The difference between true, tabulated and learned friction remains: 0.2 to 0.4 N.m rms.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(seen.given_Nm.size())), 0.5) << what;
  EXPECT_LT(seen.rms_error_rad, 1e-3) << what;
  EXPECT_FALSE(seen.off_stream) << what;
}

class StreamedSines : public ::testing::TestWithParam<bool> {};

TEST_P(StreamedSines, TakeTheTorqueOfTheMotionAndNoMoreAtEveryRateOfSamples) {
  for (const StreamedSine& sine : {StreamedSine{50, 0},
                                   {50, 1},
                                   {50, 2},
                                   {20, 0},
                                   {20, 1},
                                   {10, 0},
                                   {10, 1},
                                   {10, 2},
                                   {5, 0},
                                   {5, 1},
                                   {3, 0},
                                   {3, 1},
                                   {2, 0},
                                   {2, 1},
                                   {10, 1, 30},
                                   {20, 0, 30},
                                   {50, 1, 10},
                                   {2, 1, 100},
                                   {2, 0, 60},
                                   {10, 1, 900}})
    expect_torque_of(sine, GetParam());
}

INSTANTIATE_TEST_SUITE_P(OfAJoint, StreamedSines, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "OnASpring" : "ThatIsRigid"; });

TEST(StreamedSine, TakesItsOwnTorqueAtEveryAmplitudeAndRate) {
  for (const double amplitude_rad : {0.01, 0.03, 0.1, 0.3, 1.0})
    for (const double rate_Hz : {0.1, 0.3, 1.0, 2.0}) {
      const StreamedSine sine{
          .derivatives = 1, .ahead = 30, .amplitude_rad = amplitude_rad, .rate_Hz = rate_Hz};
      const double omega = sine.omega_rad_s();
      if (amplitude_rad * omega > 5.0 || amplitude_rad * omega * omega > 60.0) continue;
      expect_torque_of(sine, true);
    }
}

// The feedback regulates the motor's own motion. A feed-forward of that motion times the load's inertia, a period later, would excite it.
TEST(StreamedSine, CarriesALoadThatItTellsOfOnASpring) {
  for (const double load_kgm2 : {0.05, 0.2})
    expect_torque_of({.derivatives = 1, .ahead = 40, .load_kgm2 = load_kgm2}, true);
}

}  // namespace
}  // namespace strainwave::testing
