// SPDX-License-Identifier: BSD-3-Clause
#include "commission/commissioning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/input_error.h"
#include "tests/commission/commissioning_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kWrong = 1.5;

/// One complete run, shared by the tests. The drive filters the torque that it reports, as many drives do.
struct Whole {
  RandomJoint joint = random_joint(2);
  CommissioningConfig config = configure(joint);
  Bench bench{joint};
  Commissioning commissioning{config};
  Whole() {
    bench.filter_report(0.005);
    bench.run(commissioning);
  }
};

Whole& whole() {
  static Whole run;
  return run;
}

/// The defect that commissioning reports if the configuration of the joint in whole() is falsified.
std::string wrong_in(const std::function<void(ConfiguredNumbers&)>& falsify) {
  CommissioningConfig config = whole().config;
  falsify(config.configured);
  CommissionRecord record = whole().commissioning.record();
  for (CommissionValue& value : record.values) {
    if (value.key == "motor_inertia_kgm2") value.configured = config.configured.motor_inertia_kgm2;
    if (value.key == "load_inertia_kgm2") value.configured = config.configured.load_inertia_kgm2;
    if (value.key == "stiffness_Nm_rad") value.configured = config.configured.stiffness_1_Nm_rad;
  }
  return find_wrong(record.values, config.configured.gear_ratio);
}

TEST(Commissioning, MeasuresAJointInsideItsLimitsInLessThanThreeMinutes) {
  const CommissionRecord& record = whole().commissioning.record();
  EXPECT_EQ(record.problem, "") << whole().bench.lines();
  EXPECT_EQ(record.steps.size(), 6U);
  for (const CommissionStep& step : record.steps) EXPECT_EQ(step.outcome, StepOutcome::kDone) << step.name;
  EXPECT_LT(record.joint_time_s, 180.0);
  EXPECT_LE(whole().bench.speed_rad_s(), whole().config.excitation.limits.speed_rad_s);
  EXPECT_FALSE(whole().bench.enabled());
  EXPECT_GE(record.friction.size(), 3U);
  for (const CommissionValue& value : record.values) {
    if (!value.configured || value.unit == "periods") continue;
    EXPECT_NEAR(value.measured.value / *value.configured, 1.0, 0.05) << value.key;
  }
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

TEST(Commissioning, HasAResponseThatTheModelExplains) {
  const CommissionRecord& record = whole().commissioning.record();
  ASSERT_TRUE(record.model);
  ASSERT_GE(record.response.size(), 20U);
  const ResponseModel& model = *record.model;
  std::vector<double> magnitudes_dB;
  std::vector<double> phases_rad;
  for (const ResponsePoint& point : record.response) {
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * point.frequency_Hz);
    const std::complex<double> spring = model.stiffness_Nm_rad + model.damping_Nms_rad * s;
    const std::complex<double> link = model.link_inertia_kgm2 * s * s + spring;
    const std::complex<double> response =
        std::exp(-s * model.delay_s) * s * link /
        (model.motor_inertia_kgm2 * s * s * link + spring * model.link_inertia_kgm2 * s * s);
    magnitudes_dB.push_back(std::abs(20.0 * std::log10(point.magnitude_rad_sNm / std::abs(response))));
    phases_rad.push_back(
        std::abs(std::remainder(point.phase_rad - std::arg(response), 2.0 * std::numbers::pi)));
  }
  // Medians, since the windows smear the resonance and the antiresonance. Friction also fills the antiresonance.
  EXPECT_LT(median(magnitudes_dB), 2.0);
  EXPECT_LT(median(phases_rad), 0.3);
}

TEST(Commissioning, WritesEveryNumberOfItsRecord) {
  const CommissionRecord& record = whole().commissioning.record();
  EXPECT_EQ(to_json(parse_commission_record(to_json(record), "commission.json")), to_json(record));
}

TEST(Commissioning, NamesTheInertiaAndTheStiffnessThatAreWrong) {
  EXPECT_EQ(wrong_in([](ConfiguredNumbers&) {}), "");
  EXPECT_TRUE(wrong_in([](ConfiguredNumbers& n) {
                *n.load_inertia_kgm2 *= kWrong;
              }).starts_with("load_inertia_kgm2 = "));
  EXPECT_TRUE(wrong_in([](ConfiguredNumbers& n) {
                *n.motor_inertia_kgm2 *= kWrong;
              }).starts_with("motor_inertia_kgm2 = "));
  EXPECT_TRUE(wrong_in([](ConfiguredNumbers& n) {
                *n.stiffness_1_Nm_rad /= kWrong;
              }).starts_with("stiffness_Nm_rad = "));
}

TEST(Commissioning, SaysNothingOfNumbersThatAreNotConfigured) {
  EXPECT_EQ(wrong_in([](ConfiguredNumbers& n) {
              n.load_inertia_kgm2.reset();
              n.motor_inertia_kgm2.reset();
            }),
            "");
}

TEST(Commissioning, NamesAWrongRatioAndTheRightOne) {
  const RandomJoint joint = random_joint(2);
  CommissioningConfig config = configure(joint);
  // The daemon multiplies torque by the ratio, and divides position by it.
  Bench bench(joint);
  bench.scale(1.0 / kWrong, kWrong);
  const double middle = config.excitation.start_rad;
  config.excitation.gear_ratio *= kWrong;
  config.told.gear_ratio *= kWrong;
  config.configured.gear_ratio *= kWrong;
  ExcitationLimits& limits = config.excitation.limits;
  for (double* const limit : {&limits.position_min_rad, &limits.position_max_rad})
    *limit = middle / kWrong + (*limit - middle) / kWrong;
  config.excitation.start_rad = middle / kWrong;
  limits.speed_rad_s /= kWrong;
  config.excitation.encoder_resolution_rad /= kWrong;
  Commissioning commissioning(config);
  bench.run(commissioning);
  const std::string& problem = commissioning.record().problem;
  EXPECT_NE(problem.find("gear_ratio = "), std::string::npos) << bench.lines();
  const std::size_t fits = problem.find("should be ");
  ASSERT_NE(fits, std::string::npos) << problem;
  EXPECT_NEAR(std::stod(problem.substr(fits + 10)) / joint.told.gear_ratio, 1.0, 0.05);
  EXPECT_EQ(step_of(commissioning.record(), "comparison").outcome, StepOutcome::kFailed);
}

TEST(Commissioning, BrakesAndDisablesWhenItIsAbortedAndGoesOnFromThere) {
  const RandomJoint joint = random_joint(2);
  Bench bench(joint);
  Commissioning first(configure(joint));
  bench.run(first, "motion", 4000);
  EXPECT_EQ(first.record().problem, "a key was pressed");
  EXPECT_EQ(step_of(first.record(), "motion").outcome, StepOutcome::kFailed);
  EXPECT_NE(bench.lines().find("motion: ended early: a key was pressed"), std::string::npos) << bench.lines();
  EXPECT_EQ(bench.lines().find("failed"), std::string::npos) << "it was interrupted";
  EXPECT_EQ(step_of(first.record(), "friction").outcome, StepOutcome::kDone);
  EXPECT_FALSE(bench.enabled());
  EXPECT_LT(std::abs(bench.present_speed_rad_s()), 0.05);
  EXPECT_GE(first.record().friction.size(), 3U) << "what there was is kept";

  Bench again(joint);
  Commissioning second(configure(joint), parse_commission_record(to_json(first.record()), "commission.json"));
  again.run(second);
  EXPECT_EQ(second.record().problem, "");
  EXPECT_EQ(second.record().steps.size(), 6U);
  EXPECT_NE(again.lines().find("friction: done before, not run again"), std::string::npos);
  EXPECT_EQ(again.lines().find("direction: done before"), std::string::npos)
      << "the motor may have been wired anew: what moves by feedback comes after the ramps";
  EXPECT_GE(second.record().friction.size(), 3U) << "the first run's";
  EXPECT_GT(second.record().joint_time_s, first.record().joint_time_s);
}

TEST(Commissioning, KeepsNoFrictionOfAStepThatWasInterrupted) {
  const RandomJoint joint = random_joint(2);
  Bench bench(joint);
  Commissioning first(configure(joint));
  bench.run(first, "friction", 15'000);
  EXPECT_EQ(step_of(first.record(), "friction").outcome, StepOutcome::kFailed);
  EXPECT_TRUE(first.record().friction.empty());
  EXPECT_TRUE(first.record().breakaway_positive_Nm) << "of the step before";
}

TEST(Commissioning, RunsEveryStepOfAnotherJoint) {
  CommissionRecord before = whole().commissioning.record();
  before.joint = "wrist";
  Commissioning commissioning(whole().config, before);
  EXPECT_TRUE(commissioning.record().steps.empty());
}

TEST(Commissioning, BelievesAGravityThatIsKnownToAQuarterOnly) {
  const auto says_gravity = [](double half_width_Nm) {
    MotionEstimates motion;
    motion.gravity_Nm = {2.0, half_width_Nm};
    const std::vector<CommissionValue> values = compare_with(whole().config.configured, motion);
    return find_value(values, "control.gravity_Nm") != nullptr;
  };
  EXPECT_TRUE(says_gravity(0.4));
  EXPECT_FALSE(says_gravity(0.8));
}

TEST(Commissioning, RefusesARangeThatIsTooSmallBeforeItMoves) {
  CommissioningConfig config = whole().config;
  config.excitation.limits.position_min_rad = config.excitation.start_rad - 0.01;
  config.excitation.limits.position_max_rad = config.excitation.start_rad + 0.01;
  EXPECT_THROW(Commissioning{config}, InputError);
}

}  // namespace
}  // namespace strainwave::testing
