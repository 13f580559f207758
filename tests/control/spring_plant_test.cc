// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/spring_plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <string>
#include <utility>

#include "control/joint/joint_measurement.h"
#include "control/joint/link_velocity.h"
#include "control/scheduled_controller.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
const SpringPlant kJoint{0.089, 0.1, 1e4, 0.5, 2.0};
const GainRow kGain{-310.0, -990.0, -21.0};

using Vector5 = Eigen::Matrix<double, 5, 1>;

BoundedMatrix sampled(const SpringPlant& plant) {
  return spring_exponential(spring_generator(plant, kPeriod_s));
}

// Reference solution in the states of motor and link, in many small steps (RK4). State: angles of motor and link, then their speeds.
Vector5 integrate(const SpringPlant& p, const Vector5& start) {
  using State = Eigen::Vector4d;
  const double u = start(4);
  const auto slope = [&](const State& s) {
    const double spring_Nm = p.stiffness_Nm_rad * (s(0) - s(1)) + p.damping_Nms_rad * (s(2) - s(3));
    return State(s(2), s(3), (u - p.viscous_Nms_rad * s(2) - spring_Nm) / p.motor_inertia_kgm2,
                 spring_Nm / p.link_inertia_kgm2);
  };
  State s(start(0), start(0) + start(2), start(1), start(1) + start(3));
  const int steps = 2000;
  const double h = kPeriod_s / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = slope(s);
    const State k2 = slope(s + 0.5 * h * k1);
    const State k3 = slope(s + 0.5 * h * k2);
    const State k4 = slope(s + h * k3);
    s += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  Vector5 end;
  end << s(0), s(2), s(1) - s(0), s(3) - s(2), u;
  return end;
}

TEST(SpringPlant, TheExponentialIsTheSolutionOfTheDifferentialEquation) {
  for (const double stiffness : {0.0, 3e3, 1e4, 1e5}) {
    for (const double damping : {0.0, 5.0}) {
      SpringPlant plant = kJoint;
      plant.stiffness_Nm_rad = stiffness;
      plant.damping_Nms_rad = damping;
      Vector5 start;
      start << 0.2, 3.0, 1e-3, -0.4, 7.0;
      const Vector5 actual = sampled(plant).value * start;
      const Vector5 expected = integrate(plant, start);
      EXPECT_LT((actual - expected).cwiseAbs().maxCoeff(), 1e-11) << stiffness << " " << damping;
    }
  }
}

TEST(SpringPlant, TheErrorsOfTheExponentialCoverItInLongDouble) {
  using LongMatrix = Eigen::Matrix<long double, 5, 5>;
  for (const double stiffness : {1e3, 1e4, 1e5}) {
    SpringPlant plant = kJoint;
    plant.stiffness_Nm_rad = stiffness;
    const BoundedMatrix generator = spring_generator(plant, kPeriod_s);
    LongMatrix M = generator.value.cast<long double>();
    LongMatrix term = LongMatrix::Identity();
    LongMatrix sum = term;
    for (int k = 1; k < 60; ++k) {
      term = (term * M / k).eval();
      sum += term;
    }
    const BoundedMatrix actual = spring_exponential(BoundedMatrix(generator.value));
    const LongMatrix missed = (actual.value.cast<long double>() - sum).cwiseAbs();
    EXPECT_TRUE((missed.array() <= actual.error.cast<long double>().array()).all());
    EXPECT_LT((actual.error.array() / (actual.value.cwiseAbs().array() + 1.0)).maxCoeff(), 1e-9);
  }
}

TEST(SpringPlant, APeriodThatIsTooLongForTheSpringIsNotBounded) {
  SpringPlant plant = kJoint;
  plant.stiffness_Nm_rad = 1e7;
  EXPECT_FALSE(sampled(plant).error.allFinite());
}

TEST(SpringPlant, BetweenItsEndsTheExponentialIsWithinTheInterpolationsError) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double nearest = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    SpringPlant from = kJoint;
    from.damping_Nms_rad = 2.0 * share(random);
    from.stiffness_Nm_rad = 8100.0 * (1.0 + share(random));
    SpringPlant to = from;
    to.stiffness_Nm_rad *= 1.0 + share(random);
    const BoundedMatrix M0 = spring_generator(from, kPeriod_s);
    const BoundedMatrix M1 = spring_generator(to, kPeriod_s);
    const ProofMatrix bound =
        interpolation_error(M0.magnitude().cwiseMax(M1.magnitude()), (M1 - M0).magnitude());
    const double t = trial % 2 == 0 ? 0.5 : share(random);
    SpringPlant between = from;
    between.stiffness_Nm_rad += t * (to.stiffness_Nm_rad - from.stiffness_Nm_rad);
    const ProofMatrix missed =
        (sampled(between).value - (1.0 - t) * sampled(from).value - t * sampled(to).value).cwiseAbs();
    ASSERT_TRUE((missed.array() <= bound.array() + 1e-15).all());
    nearest = std::max(nearest, missed(3, 2) / bound(3, 2));
  }
  EXPECT_GT(nearest, 0.5);  // the bound is at most twice as wide as necessary
}

// The certificate's loop matrix equals the daemon's loop: JointReading and ScheduledController on the sampled joint.
TEST(SpringPlant, TheLoopIsWhatReadingAndLawDo) {
  FeedbackGains gains;
  gains.has_integrator = 1;
  gains.rule_count = 1;
  gains.set(0, kGain, StateMatrix::Identity());
  FuzzyFriction friction;
  friction.rule_count = 1;
  friction.temperature_max_C = 1.0;
  friction.rules[0].width_C = 1.0;
  PlantIdentity plant;
  plant.period_s = kPeriod_s;
  for (const auto& [side, lead] : {std::pair{EncoderSide::kMotor, 0.0},
                                   {EncoderSide::kMotor, 2.0},
                                   {EncoderSide::kLink, 0.0},
                                   {EncoderSide::kLink, 0.5}}) {
    for (int delay = 0; delay <= kMaxBoxDelay; ++delay) {
      SCOPED_TRACE("delay " + std::to_string(delay) + ", lead " + std::to_string(lead));
      JointReading reading(kPeriod_s, velocity_share(side, kPeriod_s), 1e-6);
      ScheduledController law(gains, friction, plant, lead);
      const double setpoint_rad = 0.3;
      Eigen::Vector4d state(0.31, 0.0, 0.001, 0.0);
      const auto reading_rad = [&] { return state(0) + (side == EncoderSide::kLink ? state(2) : 0.0); };
      reading.reset(reading_rad(), 0.0);
      Eigen::VectorXd x = Eigen::VectorXd::Zero(loop_states(kSpringPlantStates, delay, lead));
      x(1) = state(0) - setpoint_rad;
      x(3) = state(2);
      x(5) = reading_rad() - setpoint_rad;
      // The first sample has no change.
      if (lead != 0.0) x(6 + delay) = kGain(1) * x(5);
      const ProofMatrix E = sampled(kJoint).value;
      const ProofMatrix H = spring_loop(sampled(kJoint), kGain, {kPeriod_s, delay, side, lead}).value;
      std::deque<double> under_way(static_cast<std::size_t>(delay), 0.0);
      double largest = 0.0;
      for (int k = 0; k < 400; ++k) {
        JointMeasurement measurement;
        measurement.joint_position_rad = reading_rad();
        reading.step(measurement, setpoint_rad, setpoint_rad);
        ControllerInput input;
        input.joint_position_rad = reading.position_rad();
        input.joint_velocity_rad_s = reading.velocity_rad_s();
        input.setpoint_position_rad = setpoint_rad;
        input.torque_limit_Nm = 1e15;
        under_way.push_back(law.step(input).torque_Nm);
        const double acting_Nm = under_way.front();
        under_way.pop_front();
        largest = std::max({largest, std::abs(x(1)), std::abs(x(3))});
        ASSERT_NEAR(x(1), state(0) - setpoint_rad, 1e-11 * (1.0 + largest)) << k;
        ASSERT_NEAR(x(3), state(2), 1e-11 * (1.0 + largest)) << k;
        state = (E.topLeftCorner(4, 4) * state + E.topRightCorner(4, 1) * acting_Nm).eval();
        x = (H * x).eval();
      }
    }
  }
}

}  // namespace
}  // namespace strainwave
