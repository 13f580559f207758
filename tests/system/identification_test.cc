// SPDX-License-Identifier: BSD-3-Clause
// Identification on site, from the plan to the improved table, in virtual time. The daemon's loop runs the
// client's plan on a simulated joint whose friction is 30 % off the catalogue. The log is fitted, and a table
// is designed. With it, the joint must track as well as with a table for its true friction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "base/text_file.h"
#include "client/commands/identify_plan.h"
#include "design/friction/friction_file.h"
#include "design/friction/friction_fit.h"
#include "design/friction/friction_update.h"
#include "design/gains/controller_design.h"
#include "design/joint_defaults.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kFrictionScale = 1.3;
constexpr std::int64_t kStateEvery = 5;  // cycles, which gives 200 Hz

/// Friction relative to the catalogue's. `breakaway` scales the excess of static over Coulomb friction.
struct Scales {
  double breakaway = kFrictionScale;
  double coulomb = kFrictionScale;
  double viscous = kFrictionScale;
};

/// The simulated joint with this friction, at a constant temperature.
BenchJoint joint_at(double temperature_C, const Scales& scales = {}) {
  BenchJoint joint = demo_joint();
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  for (FrictionParameters* part :
       {&joint.drive.plant.joint.friction.asymptote, &joint.drive.plant.joint.friction.amplitude}) {
    part->static_Nm =
        scales.breakaway * (part->static_Nm - part->coulomb_Nm) + scales.coulomb * part->coulomb_Nm;
    part->coulomb_Nm *= scales.coulomb;
    part->viscous_Nms_rad *= scales.viscous;
  }
  return joint;
}

limits_v1 limits_of(const BenchJoint& joint) {
  limits_v1 limits{};
  limits.position_min_rad = joint.loop.limits.position_min_rad;
  limits.position_max_rad = joint.loop.limits.position_max_rad;
  limits.speed_limit_rad_s = joint.loop.controller.motion.velocity_rad_s;
  limits.acceleration_rad_s2 = joint.loop.controller.motion.acceleration_rad_s2;
  limits.deceleration_rad_s2 = joint.loop.controller.motion.deceleration_rad_s2;
  limits.torque_limit_Nm = joint.loop.controller.torque_limit_Nm;
  return limits;
}

/// Moves to `target_rad` until the setpoint is there. Records samples at 200 Hz in `samples`.
void leg(JointBench& bench, double target_rad, double speed_rad_s, std::vector<MotionSample>& samples) {
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.position_rad = target_rad;
  order.speed_limit_rad_s = speed_rad_s;
  ASSERT_EQ(bench.order(0, order), Reason::kAccepted);
  const auto arrived = [&] {
    const state_v1& state = bench.state(0);
    if (state.cycle % kStateEvery == 0)
      samples.push_back({1e-3 * static_cast<double>(state.cycle), bench.mode(0) == Mode::kTracking,
                         state.setpoint_velocity_rad_s, state.joint_position_rad, state.joint_velocity_rad_s,
                         state.torque_applied_Nm, state.temperature_used_C});
    return state.setpoint_position_rad == target_rad && state.setpoint_velocity_rad_s == 0.0;
  };
  ASSERT_GE(bench.step_until(arrived, 60'000), 0) << target_rad << " rad at " << speed_rad_s << " rad/s";
  ASSERT_EQ(bench.fault(0), Fault::kNone);
}

SteadyPoints identify(const BenchJoint& joint) {
  JointBench bench({joint});
  bench.bring_to_hold(0);
  IdentifyArguments arguments;
  arguments.joint = "elbow";
  const IdentifyPlan plan =
      plan_identification(arguments, limits_of(joint), bench.state(0).joint_position_rad);
  std::vector<MotionSample> samples;
  for (const Sweep& sweep : plan.sweeps) {
    leg(bench, sweep.from_rad, plan.approach_speed_rad_s, samples);
    leg(bench, sweep.to_rad, sweep.speed_rad_s, samples);
    leg(bench, sweep.from_rad, sweep.speed_rad_s, samples);
  }
  return find_steady_points(samples, joint.loop.controller.motion.velocity_rad_s > 0.0 ? 0.089 : 0.0);
}

FrictionFile catalogue() {
  const std::string path = std::string(STRAINWAVE_SOURCE_DIR) + "/data/tables/rhs17-6006-friction.json";
  return friction_file_from_json(read_text_file(path), path);
}

FuzzyFriction scaled(FuzzyFriction friction) {
  for (TemperatureRule& rule : friction.rules) {
    rule.friction.static_Nm *= kFrictionScale;
    rule.friction.coulomb_Nm *= kFrictionScale;
    rule.friction.viscous_Nms_rad *= kFrictionScale;
  }
  return friction;
}

GainTable table_for(const FuzzyFriction& friction) {
  TableRequest request;
  request.design.plant = demo_table().plant;
  request.design.friction = friction;
  request.design.weights = demo_table().primary.weights;
  request.design.initial_states = {StateVector(0.0, 1.0, 0.0)};
  request.name = "identification test";
  request.torque_limit_Nm = demo_table().torque_limit_Nm;
  return design_table(Controller::kC4, request);
}

/// RMS distance between the position and the setpoint of the same period, over moves of several lengths,
/// there and back.
double tracking_error_rad(const GainTable& table, double temperature_C) {
  JointBench bench({joint_at(temperature_C)});
  bench.joint(0).table_slot(0) = {table, 1};
  EXPECT_EQ(bench.order(0, OrderKind::kUseTable), Reason::kAccepted);
  EXPECT_EQ(bench.order(0, OrderKind::kEnable), Reason::kAccepted);
  EXPECT_GE(bench.step_until([&] { return bench.mode(0) == Mode::kHolding; }, 1000), 0);
  double squares = 0.0;
  std::int64_t count = 0;
  for (const double target_rad : {0.001, 0.01, 0.1, 1.0, 0.0}) {
    EXPECT_EQ(bench.move(0, target_rad), Reason::kAccepted);
    for (int i = 0; i < 1000; ++i, ++count) {
      bench.step();
      const state_v1& state = bench.state(0);
      squares += std::pow(state.joint_position_rad - state.setpoint_position_rad, 2);
    }
  }
  return std::sqrt(squares / static_cast<double>(count));
}

TEST(Identification, FindsTheFrictionOfAJointThatIs30PerCentOffTheCatalogue) {
  std::vector<SteadyPoint> points;
  for (const double temperature_C : {-5.0, 10.0, 30.0}) {
    const SteadyPoints found = identify(joint_at(temperature_C));
    EXPECT_GE(found.points.size(), 7U) << temperature_C;
    points.insert(points.end(), found.points.begin(), found.points.end());
  }
  const StribeckShape shape = source_stribeck_shape(50.0);
  const FrictionUpdate update(catalogue().fuzzy->friction, shape, points, 0.02, {});
  const ExponentialTemperatureLaw law = demo_joint().drive.plant.joint.friction;
  for (const double temperature_C : {-5.0, 10.0, 30.0}) {
    for (const double speed_rad_s : {0.02, 0.2, 3.0}) {
      const double truth_Nm =
          kFrictionScale * stribeck_friction_Nm(law.at(temperature_C), shape, speed_rad_s);
      EXPECT_NEAR(update.friction_Nm(temperature_C, speed_rad_s).value, truth_Nm, 0.06 * truth_Nm)
          << temperature_C << " degC, " << speed_rad_s << " rad/s";
    }
  }

  const GainTable from_catalogue = table_for(catalogue().fuzzy->friction);
  const GainTable identified = table_for(update.friction());
  const GainTable from_truth = table_for(scaled(catalogue().fuzzy->friction));
  for (const double temperature_C : {-5.0, 10.0, 30.0}) {
    const double with_catalogue = tracking_error_rad(from_catalogue, temperature_C);
    const double with_identified = tracking_error_rad(identified, temperature_C);
    const double with_truth = tracking_error_rad(from_truth, temperature_C);
    std::printf(
        "%5.1f degC: tracking error %.3e rad with the catalogue's table, %.3e identified, %.3e true "
        "friction\n",
        temperature_C, with_catalogue, with_identified, with_truth);
    EXPECT_LE(with_identified, 1.05 * with_truth) << temperature_C;
    EXPECT_LE(with_identified, 0.5 * with_catalogue) << temperature_C;
  }
}

TEST(Identification, ItsIntervalsHoldTheFrictionOfJointsDrawnAtRandom) {
  constexpr int kJoints = 40;
  constexpr double kConfidence = 0.95;
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> scale(0.7, 1.5);
  std::uniform_real_distribution<double> temperature(-5.0, 38.0);
  const StribeckShape shape = source_stribeck_shape(50.0);
  int held_static = 0;
  int held_coulomb = 0;
  int held_viscous = 0;
  std::vector<double> off;  // of static friction, in half widths
  for (int i = 0; i < kJoints; ++i) {
    BenchJoint joint = joint_at(temperature(random), {scale(random), scale(random), scale(random)});
    joint.drive.seed = random();
    const FrictionParameters truth = joint.drive.plant.joint.friction.at(joint.drive.ambient.at(0.0));
    const SteadyPoints found = identify(joint);
    const FrictionRegression fit =
        regress_friction(found.points, shape, kConfidence, UpdateWeights{}.torque_uncertainty);
    const auto in_half_widths = [](const Interval& interval, double true_value) {
      return std::abs(interval.value - true_value) / interval.half_width;
    };
    off.push_back(in_half_widths(fit.static_Nm, truth.static_Nm));
    held_static += off.back() <= 1.0 ? 1 : 0;
    held_coulomb += in_half_widths(fit.coulomb_Nm, truth.coulomb_Nm) <= 1.0 ? 1 : 0;
    held_viscous += in_half_widths(fit.viscous_Nms_rad, truth.viscous_Nms_rad) <= 1.0 ? 1 : 0;
    // A very wide interval would hold every value.
    EXPECT_LT(fit.static_Nm.half_width, 0.5 * truth.static_Nm) << i;
    EXPECT_LT(fit.coulomb_Nm.half_width, 0.05 * truth.coulomb_Nm) << i;
  }
  std::ranges::sort(off);
  std::printf(
      "of %d joints the intervals hold static %d, Coulomb %d, viscous %d; static off by %.2f half widths in "
      "the "
      "median, %.2f at most\n",
      kJoints, held_static, held_coulomb, held_viscous, off[kJoints / 2], off.back());
  for (const int held : {held_static, held_coulomb, held_viscous}) EXPECT_GE(held, kConfidence * kJoints);
}

}  // namespace
}  // namespace strainwave::testing
