// SPDX-License-Identifier: BSD-3-Clause
#include "design/fit_log_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "design/friction/friction_file.h"
#include "design/friction/friction_fit.h"
#include "design/friction/friction_log.h"
#include "design/friction/sha256.h"
#include "design/friction/student.h"
#include "design/joint_defaults.h"

namespace strainwave {

namespace {

// Points this close in temperature belong to one measurement.
constexpr double kGap_C = 3.0;
// Temperature step at which the result is judged.
constexpr double kGrid_C = 5.0;

struct Measurements {
  std::vector<SteadyPoint> points;
  std::string sha256;  ///< of all logs
};

void report(const std::string& file, const FrictionLog& log, const SteadyPoints& found) {
  std::printf("%s: %s, %zu speeds", file.c_str(), log.joint.c_str(), found.points.size());
  if (!found.points.empty()) {
    const auto [low, high] = std::ranges::minmax(found.points, {}, &SteadyPoint::temperature_C);
    std::printf(" at %.1f to %.1f degC", low.temperature_C, high.temperature_C);
  }
  std::printf("; runs left out: %d too short, %d not steady, %d without temperature, %d without return\n",
              found.too_short, found.not_steady, found.no_temperature, found.without_return);
}

Measurements read_logs(const FitLogOptions& options, const FrictionFile& prior) {
  Measurements all;
  std::string texts;
  std::string model;
  for (const std::string& file : options.logs) {
    const FrictionLog log = read_friction_log(file, options.joint);
    if (std::abs(log.gear_ratio - prior.gear_ratio) > 1e-9 * prior.gear_ratio)
      throw InputError(file, "gear_ratio", number_text(log.gear_ratio),
                       "the prior is for ratio " + number_text(prior.gear_ratio));
    if (!model.empty() && log.joint_model != model)
      throw InputError(file, "joint_model", log.joint_model,
                       "the other logs are of " + model + ": fit each joint by itself");
    model = log.joint_model;
    const SteadyPoints found = find_steady_points(log.samples, log.inertia_kgm2);
    report(file, log, found);
    all.points.insert(all.points.end(), found.points.begin(), found.points.end());
    texts += sha256_hex(read_text_file(file));
  }
  if (all.points.empty())
    throw InputError("fit: the logs hold no steady speeds: record them with strainwavectl identify");
  all.sha256 = sha256_hex(texts);
  return all;
}

/// Standard deviation of a point, from the residuals of the regressions at all temperatures.
double pooled_noise_Nm(const std::vector<FrictionRegression>& measured) {
  double squares = 0.0;
  int freedom = 0;
  for (const FrictionRegression& fit : measured) {
    squares += fit.residual_squares;
    freedom += fit.degrees_of_freedom;
  }
  return std::sqrt(squares / freedom);
}

std::vector<FrictionRegression> regress(const Measurements& all, const StribeckShape& shape,
                                        double confidence, double torque_uncertainty) {
  std::vector<FrictionRegression> measured;
  std::printf("measured, with %.0f %% confidence:\n  %8s %6s %19s %19s %19s\n", 100.0 * confidence, "degC",
              "points", "static_Nm", "coulomb_Nm", "viscous_Nms_rad");
  for (const auto& group : group_by_temperature(all.points, kGap_C)) {
    measured.push_back(regress_friction(group, shape, confidence, torque_uncertainty));
    const FrictionRegression& fit = measured.back();
    std::printf("  %8.1f %6d %9.4f +- %6.4f %9.4f +- %6.4f %9.4f +- %6.4f\n", fit.temperature_C, fit.points,
                fit.static_Nm.value, fit.static_Nm.half_width, fit.coulomb_Nm.value,
                fit.coulomb_Nm.half_width, fit.viscous_Nms_rad.value, fit.viscous_Nms_rad.half_width);
  }
  return measured;
}

/// The slowest, a middle and the fastest of the measured speeds.
std::vector<double> judged_speeds(const std::vector<SteadyPoint>& points) {
  const auto [slow, fast] = std::ranges::minmax(points, {}, &SteadyPoint::speed_rad_s);
  return {slow.speed_rad_s, std::sqrt(slow.speed_rad_s * fast.speed_rad_s), fast.speed_rad_s};
}

/// Prints the merged friction over the range of temperatures. Returns the temperatures at which it is not known well enough.
std::vector<double> judge(const FrictionUpdate& update, const FuzzyFriction& prior,
                          const std::vector<double>& speeds, double quantile, double wanted) {
  std::vector<double> missing_C;
  std::printf("merged with the prior, friction torque in N.m at three speeds:\n  %8s", "degC");
  for (const double speed : speeds) std::printf(" %15.4f rad/s", speed);
  std::printf("\n");
  for (double T = prior.temperature_min_C; T <= prior.temperature_max_C + 1e-9; T += kGrid_C) {
    double worst = 0.0;
    std::printf("  %8.1f", T);
    for (const double speed : speeds) {
      const Interval friction = update.friction_Nm(T, speed);
      const double relative = quantile * friction.half_width / friction.value;
      worst = std::max(worst, relative);
      std::printf("   %8.3f +- %4.1f %%", friction.value, 100.0 * relative);
    }
    std::printf("%s\n", worst > wanted ? "   measure here" : "");
    if (worst > wanted) missing_C.push_back(T);
  }
  return missing_C;
}

void report_missing(const std::vector<double>& missing_C, double wanted) {
  if (missing_C.empty()) {
    std::printf("no temperature is missing: friction is known to %.0f %% everywhere\n", 100.0 * wanted);
    return;
  }
  std::printf("temperatures missing (friction not known to %.0f %%):", 100.0 * wanted);
  for (const double T : missing_C) std::printf(" %.0f", T);
  std::printf(" degC; identify the joint there and give the logs together\n");
}

void check(const FitLogOptions& options) {
  const auto require = [](bool good, const char* key, double value, const std::string& allowed) {
    if (!good) throw InputError("fit", key, number_text(value), allowed);
  };
  const UpdateWeights& weights = options.weights;
  require(weights.common > 0.0, "prior-common", weights.common, "must be above 0");
  require(weights.own > 0.0, "prior-own", weights.own, "must be above 0");
  require(weights.torque_uncertainty > 0.0, "torque-uncertainty", weights.torque_uncertainty,
          "must be above 0");
  require(options.confidence > 0.0 && options.confidence < 1.0, "confidence", options.confidence,
          "must be between 0 and 1");
  require(options.wanted > 0.0, "wanted", options.wanted, "must be above 0");
}

}  // namespace

ExitStatus fit_logs(const FitLogOptions& options) {
  check(options);
  const std::string prior_text = read_text_file(options.prior);
  const FrictionFile prior = friction_file_from_json(prior_text, options.prior);
  if (!prior.fuzzy)
    throw InputError(options.prior + ": has no fuzzy rules: fit the catalogue with --model fuzzy or both");
  const FuzzyFriction& rules = prior.fuzzy->friction;
  const StribeckShape shape =
      prior.exponential ? prior.exponential->law.stribeck : source_stribeck_shape(prior.gear_ratio);

  const Measurements all = read_logs(options, prior);
  const std::vector<FrictionRegression> measured =
      regress(all, shape, options.confidence, options.weights.torque_uncertainty);
  const double noise_Nm = pooled_noise_Nm(measured);
  const FrictionUpdate update(rules, shape, all.points, noise_Nm, options.weights);
  std::printf(
      "weights: catalogue %.0f %% common and %.0f %% own deviation; points %.4f N.m and %.1f %% of the "
      "torque\n",
      100.0 * options.weights.common, 100.0 * options.weights.own, noise_Nm,
      100.0 * options.weights.torque_uncertainty);
  // The noise's own uncertainty is small beside the prior's, so that the normal distribution's quantile applies.
  constexpr int kManyDegreesOfFreedom = 100000;
  const double quantile = student_t(options.confidence, kManyDegreesOfFreedom);
  report_missing(judge(update, rules, judged_speeds(all.points), quantile, options.wanted), options.wanted);

  FrictionFile file;
  file.gear_ratio = prior.gear_ratio;
  for (const std::string& log : options.logs)
    file.data_file += (file.data_file.empty() ? "" : " ") + std::filesystem::path(log).filename().string();
  file.data_sha256 = all.sha256;
  file.fuzzy = FuzzyFrictionRecord{update.friction(), {}};
  file.fuzzy->fit.method = "logs";
  file.fuzzy->fit.weighting = "bayes";
  file.fuzzy->fit.stopped = "optimum of a linear problem";
  file.identification = IdentificationRecord{std::filesystem::path(options.prior).filename().string(),
                                             sha256_hex(prior_text),
                                             options.weights,
                                             noise_Nm,
                                             options.confidence,
                                             measured};
  write_text_file(options.out, to_json(file));
  std::printf("%s: written; next: strainwave-design gains --friction %s --out TABLE.json\n",
              options.out.c_str(), options.out.c_str());
  return ExitStatus::kDone;
}

}  // namespace strainwave
