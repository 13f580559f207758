// SPDX-License-Identifier: BSD-3-Clause
// Features from motion and torque: inertia, friction, stiffness, delay, load.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "doctor/features.h"
#include "doctor/motion_fit.h"
#include "doctor/stretches.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

// Standard deviations of healthy joints from their configuration. The daemon's notices begin at about three of them
// (kOtherInertia 30 %, kFrictionDiffers 1.5 times).
constexpr double kInertiaTolerance = 0.08;
constexpr double kFrictionTolerance = 0.13;
constexpr double kViscousTolerance = 0.15;
constexpr double kViscousFit_Nms_rad = 0.08;  // error of the tables' rules for the slope of warm friction
constexpr double kStiffnessTolerance = 0.12;
constexpr double kDelayTolerance_periods = 0.2;
constexpr double kLoadShare = 0.015;  // of the torque limit
// Largest relative deviation of a known value, and the deviations from 0 at which a wrong sign is certain.
constexpr double kKnownShare = 0.25;
constexpr double kSure = 4.0;
constexpr double kLeastWindUp_counts = 5.0;
constexpr double kInertiaKnownShare = 0.1;  // small enough to find an inertia of 1.8 times the configured

Observation ratio_of(double measured, double told, double deviation, double tolerance, std::string text) {
  const double share = deviation / std::abs(measured);
  return {std::log(std::abs(measured) / told), std::hypot(tolerance, share), std::move(text)};
}

void add_friction(const Evidence& evidence, const MotionFit& fit, Features& features) {
  const double temperature_C = evidence.mean_temperature_C();
  const auto told = evidence.friction_at(temperature_C);
  if (!told) {
    features.not_judged.emplace_back(
        "friction, torque constant and temperature sensor by friction: give --config with joint.table");
    return;
  }
  // If the joint hardly moved, neither is known well enough to be compared.
  const auto known = [](const MotionEstimate& estimate) {
    return estimate.value > 0.0 && estimate.deviation < kKnownShare * estimate.value;
  };
  if (known(fit.coulomb_Nm))
    features[Feature::kCoulomb] = ratio_of(
        fit.coulomb_Nm.value, told->coulomb_Nm, fit.coulomb_Nm.deviation, kFrictionTolerance,
        fmt::format("friction at slow speed is {:.2f} +-{:.2f} N.m, the table says {:.2f} N.m at {:.1f} degC",
                    fit.coulomb_Nm.value, fit.coulomb_Nm.deviation, told->coulomb_Nm, temperature_C));
  if (known(fit.viscous_Nms_rad))
    features[Feature::kViscous] = ratio_of(
        fit.viscous_Nms_rad.value, told->viscous_Nms_rad, fit.viscous_Nms_rad.deviation,
        std::hypot(kViscousTolerance, kViscousFit_Nms_rad / told->viscous_Nms_rad),
        fmt::format("friction grows by {:.2f} +-{:.2f} N.m.s/rad over speed, the table says {:.2f}",
                    fit.viscous_Nms_rad.value, fit.viscous_Nms_rad.deviation, told->viscous_Nms_rad));
}

/// The load inertia to configure. Empty: the joint is rigid, or the motor alone has more than the measured inertia.
std::string implied_load(const Evidence& evidence, double inertia_kgm2) {
  if (!evidence.told.link) return "";
  const double load_kgm2 = inertia_kgm2 - evidence.told.link->motor_inertia_kgm2;
  return load_kgm2 > 0.0 ? fmt::format("; with the configured motor, load_inertia_kgm2 is {:.4f}", load_kgm2)
                         : "";
}

void add_inertia(const Evidence& evidence, const MotionFit& fit, Features& features) {
  const MotionEstimate& inertia = fit.inertia_kgm2;
  if (inertia.value < -kSure * inertia.deviation)
    features[Feature::kReversed] =
        Observation{1.0, 0.1,
                    fmt::format("torque accelerates the joint the wrong way: inertia {:.3f} +-{:.3f} kg m2",
                                inertia.value, inertia.deviation)};
  if (!evidence.told.inertia_kgm2) return;
  const double share = inertia.deviation / std::min(std::abs(inertia.value), *evidence.told.inertia_kgm2);
  if (share > kInertiaKnownShare)
    features.not_judged.emplace_back(
        evidence.samples.back().fault != 0
            ? "inertia: the fault ended the motion too early to show it"
            : fmt::format("inertia: {:.1f} rad/s2 show it to {:.0f} % only; {:.1f} rad/s2 are needed",
                          fit.acceleration_rad_s2, 100.0 * share,
                          fit.acceleration_rad_s2 * share / kInertiaKnownShare));
  else
    features[Feature::kInertia] = ratio_of(
        inertia.value, *evidence.told.inertia_kgm2, inertia.deviation, kInertiaTolerance,
        fmt::format("inertia is {:.4f} +-{:.4f} kg m2, the configuration says {:.4f}{}", inertia.value,
                    inertia.deviation, *evidence.told.inertia_kgm2, implied_load(evidence, inertia.value)));
}

/// Wind-up of the gear by the link's inertia, in counts of the encoder.
double wind_up_counts(const Evidence& evidence, const MotionFit& fit) {
  const ConfiguredLink& link = *evidence.told.link;
  return link.link_inertia_kgm2 * fit.acceleration_rad_s2 / link.spring.stiffness_1_Nm_rad /
         evidence.count_rad();
}

bool knows_stiffness(const Evidence& evidence, const MotionFit& fit) {
  return fit.stiffness_scale && fit.stiffness_scale->deviation <= kKnownShare * fit.stiffness_scale->value &&
         wind_up_counts(evidence, fit) >= kLeastWindUp_counts;
}

void add_delay(const Evidence& evidence, const MotionFit& fit, Features& features) {
  if (!evidence.told.delay_periods) {
    features.not_judged.emplace_back("delay: give --config with delay_periods");
    return;
  }
  if (fit.delay_periods.deviation > 0.5) {
    features.not_judged.emplace_back(fmt::format(
        "delay: the recording shows it to {:.1f} periods only; set daemon.state_rate_Hz to the loop's rate",
        fit.delay_periods.deviation));
    return;
  }
  if (evidence.told.link && !knows_stiffness(evidence, fit)) {
    features.not_judged.emplace_back("delay: the motion does not distinguish it from the spring");
    return;
  }
  features[Feature::kDelay] = Observation{
      fit.delay_periods.value - *evidence.told.delay_periods,
      std::hypot(kDelayTolerance_periods, fit.delay_periods.deviation),
      fmt::format("torque acts {:.2f} +-{:.2f} periods after its command, the configuration says {}",
                  fit.delay_periods.value, fit.delay_periods.deviation, *evidence.told.delay_periods)};
}

void add_stiffness(const Evidence& evidence, const MotionFit& fit, Features& features) {
  if (!evidence.told.link) return;
  if (!knows_stiffness(evidence, fit)) {
    const double counts = wind_up_counts(evidence, fit);
    features.not_judged.push_back(counts >= kLeastWindUp_counts
                                      ? "stiffness: the motion does not show it"
                                      : fmt::format("stiffness: at {:.1f} rad/s2 the gear winds up by {:.1f} "
                                                    "counts only; {:.1f} rad/s2 are needed",
                                                    fit.acceleration_rad_s2, counts,
                                                    fit.acceleration_rad_s2 * kLeastWindUp_counts / counts));
    return;
  }
  const MotionEstimate& scale = *fit.stiffness_scale;
  const double told_Nm_rad = evidence.told.link->spring.stiffness_1_Nm_rad;
  features[Feature::kStiffness] =
      ratio_of(scale.value, 1.0, scale.deviation, kStiffnessTolerance,
               fmt::format("stiffness is {:.0f} +-{:.0f} N.m/rad, the configuration says {:.0f}",
                           scale.value * told_Nm_rad, scale.deviation * told_Nm_rad, told_Nm_rad));
}

// A limit cycle from the first stroke on stops the joint before its motion shows the delay. The torque that the drive reports then shows it.
// A drive that reports the command instead of a measurement never seems late.
void add_torque_lag(const Evidence& evidence, Features& features) {
  if (!evidence.told.delay_periods || evidence.stride_periods() != 1) return;
  constexpr std::size_t kMostLag = 12;
  std::array<double, kMostLag + 1> squares{};
  for (const Stretch& stretch : controlled_stretches(evidence))
    for (std::size_t i = kMostLag; i < stretch.applied_Nm.size(); ++i)
      for (std::size_t lag = 0; lag <= kMostLag; ++lag)
        squares[lag] += std::pow(stretch.applied_Nm[i] - stretch.torque_Nm[i - lag], 2);
  const auto best = std::min_element(squares.begin() + 1, squares.end() - 1);
  // A torque that hardly varies fits any lag.
  if (*best > 0.5 * std::min(best[-1], best[1])) return;
  // The reported torque acted in the period before.
  const auto lag_periods = static_cast<double>(best - squares.begin()) - 1.0;
  features[Feature::kTorqueLag] = Observation{
      std::max(0.0, lag_periods - *evidence.told.delay_periods), kDelayTolerance_periods,
      fmt::format("the drive's torque comes {:.0f} periods after its command, the configuration says {}",
                  lag_periods, *evidence.told.delay_periods)};
}

// A runaway joint is stopped too soon for the fit. Its speed grows although the torque acts against the motion.
void add_runaway(const Evidence& evidence, Features& features) {
  constexpr double kBefore_s = 0.06;
  constexpr double kLeastTorque = 0.2;  // mean, share of the limit; less holds back a falling load
  constexpr double kLeastSpeed_rad_s = 0.3;
  const double limit_Nm = evidence.torque_limit_Nm();
  const auto& samples = evidence.samples;
  for (std::size_t end = 2; end < samples.size(); ++end) {
    if (samples[end].fault == 0 || samples[end - 1].fault != 0) continue;
    // An oscillating torque acts as often against the motion as with it.
    if (static_cast<Fault>(samples[end].fault) == Fault::kChatter) return;
    std::size_t begin = end - 1;
    double work_J = 0.0, torque_Nm = 0.0;
    while (begin > 0 &&
           static_cast<double>(samples[end].cycle - samples[begin].cycle) * evidence.period_s < kBefore_s) {
      const double step_rad = samples[begin].joint_position_rad - samples[begin - 1].joint_position_rad;
      work_J += samples[begin - 1].torque_commanded_Nm * step_rad;
      torque_Nm += std::abs(samples[begin].torque_commanded_Nm);
      --begin;
    }
    torque_Nm /= static_cast<double>(end - begin);
    const double speed_rad_s =
        (samples[end].joint_position_rad - samples[end - 1].joint_position_rad) /
        (static_cast<double>(samples[end].cycle - samples[end - 1].cycle) * evidence.period_s);
    const bool runaway =
        work_J < 0.0 && torque_Nm > kLeastTorque * limit_Nm && std::abs(speed_rad_s) > kLeastSpeed_rad_s;
    if (runaway)
      features[Feature::kReversed] = Observation{
          1.0, 0.1,
          fmt::format("before the fault the joint gained {:.1f} rad/s against a torque of {:.1f} N.m",
                      std::abs(speed_rad_s), torque_Nm)};
    return;
  }
}

}  // namespace

void add_motion_features(const Evidence& evidence, Features& features) {
  add_runaway(evidence, features);
  add_torque_lag(evidence, features);
  const auto fit = fit_motion(evidence);
  if (!fit) {
    features.not_judged.emplace_back(fmt::format(
        "inertia, friction, delay, load: the recording has fewer than {} windows of controlled motion",
        kLeastMotionWindows));
    return;
  }
  // A limit cycle does not show sliding friction. It shows the inertia of a rigid joint, but mixes motor, link and spring of a flexible one.
  const bool chattered = evidence.chattered();
  if (chattered)
    features.not_judged.emplace_back(
        fmt::format("{}friction: torque oscillated until the fault, as with a longer delay, another "
                    "stiffness or another load than configured",
                    evidence.told.link ? "inertia and " : ""));
  if (!chattered || !evidence.told.link) add_inertia(evidence, *fit, features);
  if (!chattered) add_friction(evidence, *fit, features);
  add_delay(evidence, *fit, features);
  add_stiffness(evidence, *fit, features);
  features[Feature::kLoad] = Observation{
      fit->load_Nm, std::hypot(kLoadShare * evidence.torque_limit_Nm(), fit->load_deviation_Nm),
      fmt::format("at {:.2f} rad {:+.2f} +-{:.2f} N.m push the joint in addition to the configured gravity",
                  fit->load_at_rad, -fit->load_Nm, fit->load_deviation_Nm)};
}

}  // namespace strainwave
