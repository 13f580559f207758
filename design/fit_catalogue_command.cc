// SPDX-License-Identifier: BSD-3-Clause
#include "design/fit_catalogue_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "design/friction/catalogue.h"
#include "design/friction/descending_curve.h"
#include "design/friction/estimation.h"
#include "design/friction/fit_checks.h"
#include "design/friction/friction_file.h"
#include "design/friction/ordered_memberships.h"
#include "design/joint_defaults.h"

namespace strainwave {

namespace {

struct Job {
  FitCatalogueOptions options;
  FrictionData data;
  FitProblem problem;  // without the outliers that are left out
  double min_C = 0.0;  // of the data
  double max_C = 0.0;
  std::vector<Outlier> outliers;  // rows of the data

  // A decay much shorter than the data's spacing looks like a step; one much longer than their range, like a line.
  double least_decay_C() const { return 1.0; }
  double largest_decay_C() const { return 10.0 * (max_C - min_C); }
};

constexpr double kMaxGearRatio = 1e5;
// A rule has a centre and a width, which take two temperatures to determine.
constexpr int kTemperaturesPerRule = 2;

void check(const FitCatalogueOptions& options) {
  const auto require = [](bool good, const char* key, double value, const std::string& allowed) {
    if (!good) throw InputError("fit", key, number_text(value), allowed);
  };
  require(options.gear_ratio > 0.0 && options.gear_ratio <= kMaxGearRatio, "gear-ratio", options.gear_ratio,
          "must be above 0, at most 100000");
  const double starting_torque_Ncm = options.starting_torque_Ncm.value_or(0.0);
  require(starting_torque_Ncm >= 0.0, "starting-torque_Ncm", starting_torque_Ncm, "must not be negative");
  require(options.threads >= 0, "threads", options.threads, "must not be negative");
  require(options.rules >= 2 && options.rules <= kMaxTemperatureRules, "rules", options.rules,
          "must be from 2 to " + std::to_string(kMaxTemperatureRules));
}

Job make_job(const FitCatalogueOptions& options) {
  check(options);
  Job job;
  job.options = options;
  job.data = read_catalogue(options.catalogue, options.starting_torque_Ncm);
  const FitWeighting weighting =
      options.weighting == "source" ? FitWeighting::kSource : FitWeighting::kTorque;
  job.problem = {fit_targets(job.data), friction_metric(weighting, job.data.motor_speeds_rpm),
                 !options.unconstrained};
  job.min_C = job.data.points.front().temperature_C;
  job.max_C = job.data.points.back().temperature_C;
  job.outliers = find_outliers(job.problem, job.least_decay_C(), job.largest_decay_C());
  if (options.outliers == "leave-out") {
    std::vector<Outlier> from_the_end = job.outliers;
    std::ranges::sort(from_the_end, std::ranges::greater{}, &Outlier::row);
    for (const Outlier& outlier : from_the_end) job.problem = without_row(job.problem, outlier.row);
  }
  return job;
}

template <typename Fit>
FitRecord make_record(const Job& job, const Fit& fit, const EpgsResult* search) {
  FitRecord record;
  record.method = job.options.method;
  record.weighting = job.options.weighting;
  record.physical = job.problem.physical;
  record.stopped = "optimum of a linear problem";
  if (search != nullptr) {
    record.seed = job.options.seed;
    record.generations = search->generations;
    record.evaluations = search->evaluations;
    record.stopped = name_of(search->stop);
    record.best_by_generation = search->best_by_generation;
  }
  const FitTargets& targets = job.problem.targets;
  const Eigen::MatrixX3d errors = targets.parameters - predict(fit, targets.temperature_C);
  record.cost_source = metric_cost(errors, friction_metric(FitWeighting::kSource, job.data.motor_speeds_rpm));
  record.cost_torque = metric_cost(errors, friction_metric(FitWeighting::kTorque, job.data.motor_speeds_rpm));
  for (Eigen::Index k = 0; k < errors.rows(); ++k) {
    record.residuals.push_back({targets.temperature_C(k), {errors(k, 0), errors(k, 1), errors(k, 2)}});
  }
  return record;
}

EpgsOptions search_options(const Job& job, EpgsOptions options) {
  options.seed = job.options.seed;
  options.threads =
      job.options.threads > 0 ? job.options.threads : static_cast<int>(std::thread::hardware_concurrency());
  return options;
}

Estimate<ExponentialFit> fit_law(const Job& job) {
  if (job.options.method == "epgs")
    return estimate_exponential(job.problem, job.least_decay_C(), job.largest_decay_C(),
                                search_options(job, exponential_search_options()));
  Estimate<ExponentialFit> estimate;
  estimate.fit = fit_exponential(job.problem, job.least_decay_C(), job.largest_decay_C());
  return estimate;
}

/// The better of two fits: the memberships found, with consequents that make the curve fall, or ordered memberships.
/// Free memberships may return to a colder rule at the warm end. Then only a constant curve would fall.
FuzzyFit fall_everywhere(const Job& job, const FitProblem& problem, const MembershipBox& box,
                         const FuzzyFit& found) {
  std::vector<FuzzyFit> candidates{found};
  std::optional<FuzzyFit> best;
  if (job.options.method == "epgs")
    best = candidates.emplace_back(
        fit_ordered_memberships(problem, job.options.rules, box, job.min_C, job.max_C, job.options.seed));
  for (const FuzzyFit& memberships : candidates) {
    const auto fit =
        fit_descending_curve(problem, memberships.center_C, memberships.width_C, job.min_C, job.max_C);
    if (fit && (!best || fit->cost < best->cost)) best = fit;
  }
  if (!best)
    throw NotAchieved("fit: no friction that falls with temperature everywhere was found for " +
                      std::to_string(job.options.rules) +
                      " rules: use --method epgs, or --non-increasing rules");
  return *best;
}

/// Fits the rules to `problem`: a search with `options` for the memberships, then consequents under the requested condition.
Estimate<FuzzyFit> fit_rules(const Job& job, const FitProblem& problem, const EpgsOptions& options) {
  Estimate<FuzzyFit> estimate;
  MembershipBox box;
  box.center_min_C = job.min_C - 5.0;
  box.center_max_C = job.max_C + 5.0;
  if (job.options.method == "epgs") {
    estimate = estimate_fuzzy(problem, job.options.rules, box, options);
  } else {
    const Memberships memberships = graded_memberships(job.options.rules, job.min_C, job.max_C);
    estimate.fit = fit_consequents(problem, memberships.center_C, memberships.width_C);
  }
  if (job.problem.physical && job.options.non_increasing == "curve")
    estimate.fit = fall_everywhere(job, problem, box, estimate.fit);
  return estimate;
}

/// The exponential law, sampled so densely that the rules cannot deviate between the samples.
FitProblem sampled_law(const Job& job, const ExponentialFit& law) {
  constexpr Eigen::Index kTemperatures = 51;
  FitProblem problem = job.problem;
  problem.targets.temperature_C = Eigen::VectorXd::LinSpaced(kTemperatures, job.min_C, job.max_C);
  problem.targets.parameters = predict(law, problem.targets.temperature_C);
  return problem;
}

/// Whether the rules follow the law instead of the data. Prints the reason if `auto` decides so.
bool rules_follow_the_law(const Job& job) {
  if (job.options.rules_from != "auto") return job.options.rules_from == "exponential";
  const auto temperatures = static_cast<int>(job.problem.targets.temperature_C.size());
  if (temperatures >= kTemperaturesPerRule * job.options.rules) return false;
  std::printf(
      "  WARNING: %d temperatures are too few for %d rules, which need at least %d: the rules follow the "
      "exponential law instead (--rules-from)\n",
      temperatures, job.options.rules, kTemperaturesPerRule * job.options.rules);
  return true;
}

/// Static, Coulomb and viscous friction, as the fit orders them.
constexpr std::array<const char*, 3> kParameterNames{"static", "Coulomb", "viscous"};

void report_rise(const Job& job, const FuzzyFit& fit) {
  constexpr double kTold = 0.001;
  const CurveRise rise = worst_rise(fit, job.min_C, job.max_C);
  if (rise.share > kTold)
    std::printf("  WARNING: %s friction rises by %.1f %% towards %.1f degC%s\n",
                kParameterNames[static_cast<std::size_t>(rise.parameter)], 100.0 * rise.share,
                rise.temperature_C, job.problem.physical ? " (--non-increasing curve)" : "");
}

/// `law`: the law, if it is already fitted. Otherwise it is fitted here if the rules follow it.
FuzzyFrictionRecord fit_fuzzy_model(const Job& job, const std::optional<ExponentialFit>& law) {
  const bool follow = rules_follow_the_law(job);
  const FitProblem problem = follow ? sampled_law(job, law ? *law : fit_law(job).fit) : job.problem;
  const Estimate<FuzzyFit> estimate = fit_rules(job, problem, search_options(job, fuzzy_search_options()));
  report_rise(job, estimate.fit);
  const bool search = job.options.method == "epgs";
  FuzzyFrictionRecord record{to_joint_side(estimate.fit, job.options.gear_ratio, job.min_C, job.max_C),
                             make_record(job, estimate.fit, search ? &estimate.search : nullptr)};
  if (follow) record.fit.method += " of the exponential law";
  return record;
}

void report(const char* model, const FitRecord& fit) {
  std::printf(
      "  %-12s cost %.5f (source's, motor side, N.cm), %.5f (torque); %d generations, %lld evaluations\n",
      model, fit.cost_source, fit.cost_torque, fit.generations, static_cast<long long>(fit.evaluations));
}

void report_residuals(const char* model, const FitRecord& fit) {
  for (std::size_t parameter = 0; parameter < kParameterNames.size(); ++parameter) {
    double squares = 0.0;
    const FitResidual* worst = &fit.residuals.front();
    for (const FitResidual& at : fit.residuals) {
      squares += at.motor[parameter] * at.motor[parameter];
      if (std::abs(at.motor[parameter]) > std::abs(worst->motor[parameter])) worst = &at;
    }
    std::printf("  %-12s %-8s residuals: RMS %.3g, largest %.3g at %g degC (%s)\n", model,
                kParameterNames[parameter], std::sqrt(squares / static_cast<double>(fit.residuals.size())),
                worst->motor[parameter], worst->temperature_C, parameter == 2 ? "N.cm/RPM" : "N.cm");
  }
}

void report_outliers(const Job& job) {
  for (const Outlier& outlier : job.outliers) {
    const FrictionPoint& point = job.data.points[static_cast<std::size_t>(outlier.row)];
    std::printf(
        "  WARNING: %g degC is an outlier: static %+.3g, Coulomb %+.3g N.cm, viscous %+.3g N.cm/RPM from the "
        "law of the others; the cost is %.3g without it and %.3g with it; %s\n",
        point.temperature_C, outlier.error(0), outlier.error(1), outlier.error(2), outlier.cost_without,
        outlier.cost,
        job.options.outliers == "keep" ? "it distorts the whole fit: correct it, or give --outliers leave-out"
                                       : "left out");
  }
}

void report_growth(const Job& job) {
  constexpr double kNoticeable = 1.1;
  const double growth = growth_with_temperature(job.problem);
  if (growth > kNoticeable)
    std::printf(
        "  WARNING: friction is %.3g times as large in the warmer half of %g to %g degC as in the colder. "
        "The friction of a strain-wave gear falls with temperature, and the fit lets none rise. Are the "
        "temperatures in the wrong order?\n",
        growth, job.min_C, job.max_C);
}

}  // namespace

ExitStatus fit_catalogue(const FitCatalogueOptions& options) {
  const Job job = make_job(options);
  FrictionFile file;
  file.gear_ratio = options.gear_ratio;
  file.data_file = std::filesystem::path(options.catalogue).filename().string();
  file.data_sha256 = job.data.sha256;
  std::printf("%s: %s, minimising the %s cost%s\n", options.out.c_str(), options.method.c_str(),
              options.weighting.c_str(), options.unconstrained ? ", unconstrained" : "");
  if (!job.data.has_starting_torque)
    std::printf(
        "  no column starting_torque_Ncm: static friction is taken %.3g N.cm above Coulomb friction at every "
        "temperature (%s)\n",
        job.data.motor_excess_Ncm,
        options.starting_torque_Ncm ? "--starting-torque_Ncm at 25 degC"
                                    : "as Zhao (2006) has it; --starting-torque_Ncm");
  report_growth(job);
  report_outliers(job);
  std::optional<ExponentialFit> known_law;
  if (options.model != "fuzzy") {
    const Estimate<ExponentialFit> law = fit_law(job);
    known_law = law.fit;
    file.exponential = {
        {to_joint_side(law.fit, options.gear_ratio), source_stribeck_shape(options.gear_ratio)},
        make_record(job, law.fit, options.method == "epgs" ? &law.search : nullptr)};
    report("exponential", file.exponential->fit);
    report_residuals("exponential", file.exponential->fit);
  }
  if (options.model != "exponential") {
    file.fuzzy = fit_fuzzy_model(job, known_law);
    report("fuzzy", file.fuzzy->fit);
    report_residuals("fuzzy", file.fuzzy->fit);
  }
  write_text_file(options.out, to_json(file));
  return ExitStatus::kDone;
}

}  // namespace strainwave
