// SPDX-License-Identifier: BSD-3-Clause
// The doctor on motions with known numbers, and on three random joints of the study for each cause.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "doctor/causes.h"
#include "doctor/diagnosis.h"
#include "doctor/motion_fit.h"
#include "doctor/test_motion.h"
#include "tests/doctor/patient.h"

namespace strainwave::testing {
namespace {

struct Truth {
  double inertia_kgm2 = 0.2, coulomb_Nm = 1.5, viscous_Nms_rad = 0.6, load_Nm = 0.0;
  int delay_periods = 2;
};

/// Strokes of a rigid joint by formula: q is the sum of two sines, and the torque leads its effect by `delay_periods`.
Evidence swinging(const Truth& truth, std::int64_t stride) {
  Evidence evidence;
  const double period_s = evidence.period_s;
  const auto torque_Nm = [&](double t) {
    const double speed = 1.5 * std::cos(3.0 * t) + 0.4 * std::cos(17.0 * t);
    const double acceleration = -4.5 * std::sin(3.0 * t) - 6.8 * std::sin(17.0 * t);
    return truth.inertia_kgm2 * acceleration + std::copysign(truth.coulomb_Nm, speed) +
           truth.viscous_Nms_rad * speed + truth.load_Nm;
  };
  for (std::int64_t cycle = 0; cycle < 12'000; cycle += stride) {
    const double t = static_cast<double>(cycle) * period_s;
    DoctorSample sample;
    sample.cycle = cycle;
    sample.mode = static_cast<std::int32_t>(Mode::kTracking);
    sample.joint_position_rad = 0.5 * std::sin(3.0 * t) + 0.4 / 17.0 * std::sin(17.0 * t);
    sample.torque_commanded_Nm = torque_Nm(t + (truth.delay_periods + 0.5) * period_s);
    sample.torque_applied_Nm = sample.torque_commanded_Nm;
    evidence.samples.push_back(sample);
  }
  return evidence;
}

TEST(MotionFit, FindsTheNumbersThatMadeTheMotion) {
  for (const std::int64_t stride : {1, 5}) {
    Truth truth;
    truth.load_Nm = 0.4;
    const auto fit = fit_motion(swinging(truth, stride));
    ASSERT_TRUE(fit) << stride;
    EXPECT_NEAR(fit->inertia_kgm2.value, truth.inertia_kgm2, 0.03 * truth.inertia_kgm2) << stride;
    EXPECT_NEAR(fit->coulomb_Nm.value, truth.coulomb_Nm, 0.05 * truth.coulomb_Nm) << stride;
    EXPECT_NEAR(fit->viscous_Nms_rad.value, truth.viscous_Nms_rad, 0.1 * truth.viscous_Nms_rad) << stride;
    EXPECT_NEAR(fit->load_Nm, truth.load_Nm, 0.1) << stride;
    EXPECT_NEAR(fit->delay_periods.value, truth.delay_periods, 0.3) << stride;
  }
}

TEST(MotionFit, SeesTorqueThatActsAgainstItsSign) {
  Evidence evidence = swinging({}, 1);
  for (DoctorSample& sample : evidence.samples) sample.torque_commanded_Nm *= -1.0;
  const auto fit = fit_motion(evidence);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->inertia_kgm2.value, 0.0);
}

TEST(MotionFit, NeedsMotionUnderControl) {
  Evidence evidence = swinging({}, 1);
  for (DoctorSample& sample : evidence.samples) sample.mode = static_cast<std::int32_t>(Mode::kOff);
  EXPECT_FALSE(fit_motion(evidence));
}

TEST(Doctor, SaysWhatItCouldNotJudgeWithoutAConfiguration) {
  const Diagnosis diagnosis = diagnose(swinging({}, 1));
  std::string all;
  for (const std::string& open : diagnosis.not_judged) all += open + "\n";
  for (const char* what : {"friction", "delay", "--config", "coupling"})
    EXPECT_NE(all.find(what), std::string::npos) << what << " in\n" << all;
}

TEST(Doctor, NamesNoRealTimeOnlyWhereTheDaemonFaultedForIt) {
  Evidence evidence = swinging({}, 1);
  timing_v1 timing{};
  timing.cycles = 12'000;
  timing.overruns = 100;
  evidence.timings.push_back(timing);  // a desktop: no real time, late cycles
  EXPECT_TRUE(diagnose(evidence).findings.empty());
  evidence.samples.back().fault = static_cast<std::int32_t>(Fault::kPeriodsMissed);
  const Diagnosis diagnosis = diagnose(evidence);
  ASSERT_FALSE(diagnosis.findings.empty());
  EXPECT_EQ(diagnosis.findings.front().cause, "no real time");
}

/// Causes that diagnose() names for a healthy joint. The sender's clock leads the loop's by `ahead_s` of the cycle.
std::string named_with_clock(const std::function<double(std::int64_t)>& ahead_s) {
  Evidence evidence = swinging({}, 1);
  for (DoctorSample& sample : evidence.samples)
    sample.utime = 1'000'000'000 + sample.cycle * 1000 + std::llround(1e6 * ahead_s(sample.cycle));
  std::string names;
  for (const Finding& finding : diagnose(evidence).findings) names += std::string(finding.cause) + "\n";
  return names;
}

TEST(Doctor, TellsAClockThatJumpsFromMessagesThatAreLate) {
  const std::string clock = "clock trouble\n";
  EXPECT_EQ(named_with_clock([](std::int64_t cycle) { return cycle < 6000 ? 0.0 : 0.3; }), clock);
  EXPECT_EQ(named_with_clock([](std::int64_t cycle) { return 1e-5 * static_cast<double>(cycle); }), clock);
  EXPECT_EQ(named_with_clock([](std::int64_t cycle) {
              const std::int64_t since = cycle % 700;  // held up for 60 ms, then sent one by one
              return since < 60 ? 1e-3 * static_cast<double>(60 - since) : 0.0;
            }),
            "");
}

TEST(Doctor, SeesTheDelayInTorqueThatTheDriveMeasures) {
  for (const int lag_periods : {2, 5}) {
    Evidence evidence = swinging({.delay_periods = 1}, 1);
    evidence.told.delay_periods = 1;
    for (std::size_t i = evidence.samples.size() - 1; i > 10; --i)
      evidence.samples[i].torque_applied_Nm =
          evidence.samples[i - static_cast<std::size_t>(lag_periods)].torque_commanded_Nm;
    const Features features = features_of(evidence);
    ASSERT_TRUE(features[Feature::kTorqueLag]);
    EXPECT_EQ(features[Feature::kTorqueLag]->value, lag_periods - 2) << "acted in the period before";
  }
}

TEST(Doctor, JudgesTheInertiaOfASlowJointOrSaysWhatItNeeds) {
  for (const double acceleration_rad_s2 : {2.0, 30.0})
    for (int i = 0; i < 2; ++i) {
      Patient patient = random_patient("inertia", i);
      patient.loop.controller.motion = {1.0, acceleration_rad_s2, acceleration_rad_s2};
      double seconds = 0.0;
      const Diagnosis diagnosis = diagnose(examine(patient, 1, seconds));
      const bool named = !diagnosis.findings.empty() && diagnosis.findings.front().cause == "inertia";
      bool open = false;
      for (const std::string& line : diagnosis.not_judged)
        open = open || (line.starts_with("inertia: ") && line.ends_with(" rad/s2"));
      EXPECT_TRUE(named || open) << acceleration_rad_s2 << " rad/s2, joint " << i;
    }
}

TEST(MotionFit, FindsTheSpringUnderALoadAndAnUnevenGear) {
  for (const int i : {1, 7}) {
    double seconds = 0.0;
    const auto fit = fit_motion(examine(random_patient("gravity", i), 1, seconds));
    ASSERT_TRUE(fit && fit->stiffness_scale);
    EXPECT_NEAR(fit->stiffness_scale->value, 1.0, 0.2) << i;
  }
}

// Twice the ratio makes the feedback four times as stiff. The wrong sign, with a shift by half a period of the oscillation, explains the
// motion of joint 2006 slightly better.
TEST(Doctor, NamesTheRatioOfARigidJointThatOscillatesForIt) {
  for (const int i : {302, 326, 2006}) {
    double seconds = 0.0;
    const Evidence evidence = examine(random_patient("gear ratio", i), 1, seconds);
    ASSERT_TRUE(evidence.chattered()) << i;
    const Diagnosis diagnosis = diagnose(evidence);
    ASSERT_FALSE(diagnosis.findings.empty()) << i;
    EXPECT_EQ(diagnosis.findings.front().cause, "gear ratio") << i;
  }
}

TEST(TestMotion, StaysWithinLimitsAndReachAndComesBack) {
  limits_v1 limits{};
  limits.position_min_rad = -0.2;
  limits.position_max_rad = 3.0;
  limits.speed_limit_rad_s = 4.0;
  limits.acceleration_rad_s2 = 30.0;
  const auto strokes = plan_test_motion(limits, 0.1, 0.5);
  ASSERT_FALSE(strokes.empty());
  for (const TestStroke& stroke : strokes) {
    EXPECT_GE(stroke.position_rad, -0.2);
    EXPECT_LE(stroke.position_rad, 0.6);
    EXPECT_LE(stroke.speed_rad_s, 4.0);
    EXPECT_GT(stroke.speed_rad_s, 0.0);
  }
  EXPECT_EQ(strokes.back().position_rad, 0.1);
  EXPECT_LT(duration_s(strokes, limits, 0.1), 60.0);
  limits.position_max_rad = -0.15;
  EXPECT_TRUE(plan_test_motion(limits, -0.18, 0.5).empty());
}

// The complete study, with 10 joints for each cause, is doctor_study.
TEST(DoctorStudy, NamesNineOfTenCausesFirst) {
  constexpr int kJoints = 3;
  int named = 0;
  std::ostringstream missed;
  for (const Cause& cause : causes()) {
    int of_this = 0;
    for (int i = 0; i < kJoints; ++i) {
      double seconds = 0.0;
      const Diagnosis diagnosis = diagnose(examine(random_patient(std::string(cause.name), i), 1, seconds));
      const bool right = !diagnosis.findings.empty() && diagnosis.findings.front().cause == cause.name;
      EXPECT_LT(seconds, 120.0);
      of_this += right ? 1 : 0;
      if (!right) missed << cause.name << ' ' << i << '\n';
    }
    EXPECT_GT(of_this, 0) << "no joint with: " << cause.name;
    named += of_this;
  }
  EXPECT_GE(named, std::lround(0.9 * kJoints * static_cast<double>(causes().size()))) << missed.str();
}

TEST(DoctorStudy, FindsNothingOnHealthyJoints) {
  for (int i = 0; i < 10; ++i) {
    double seconds = 0.0;
    const Diagnosis diagnosis = diagnose(examine(random_patient("", i), 1, seconds));
    for (const Finding& finding : diagnosis.findings) ADD_FAILURE() << "joint " << i << ": " << finding.cause;
  }
}

}  // namespace
}  // namespace strainwave::testing
