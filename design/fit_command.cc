#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include "base/input_error.h"
#include "base/text_file.h"
#include "design/catalogue.h"
#include "design/commands.h"
#include "design/estimation.h"
#include "design/fit_log_command.h"
#include "design/friction_file.h"

namespace strainwave {

namespace {

struct Options {
  std::string catalogue;
  std::string out;
  std::string model = "both";
  std::string method = "epgs";
  std::string weighting = "torque";
  bool unconstrained = false;
  unsigned long long seed = 1;
  int threads = 0;
  int rules = 5;
  double gear_ratio = 50.0;
  double starting_torque_Ncm = 1.6;
  FitLogOptions log;
};

struct Job {
  Options options;
  FrictionData data;
  FitProblem problem;
  double min_C = 0.0;  // of the data
  double max_C = 0.0;
};

void check(const Options& options) {
  const auto require = [](bool good, const char* key, double value, const std::string& allowed) {
    if (!good) throw InputError("fit", key, std::to_string(value), allowed);
  };
  require(options.gear_ratio > 0.0, "gear-ratio", options.gear_ratio, "must be above 0");
  require(options.starting_torque_Ncm >= 0.0, "starting-torque_Ncm", options.starting_torque_Ncm,
          "must not be negative");
  require(options.rules >= 2 && options.rules <= kMaxTemperatureRules, "rules", options.rules,
          "must be from 2 to " + std::to_string(kMaxTemperatureRules));
}

Job make_job(const Options& options) {
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
    record.residuals.push_back({targets.temperature_C(k), errors(k, 0), errors(k, 1), errors(k, 2)});
  }
  return record;
}

EpgsOptions search_options(const Job& job, EpgsOptions options) {
  options.seed = job.options.seed;
  options.threads =
      job.options.threads > 0 ? job.options.threads : static_cast<int>(std::thread::hardware_concurrency());
  return options;
}

ExponentialFriction fit_exponential_model(const Job& job) {
  // A decay over much less than the data's spacing, or much more than their range, cannot be told from a step
  // or a line.
  const double low_C = 1.0;
  const double high_C = 10.0 * (job.max_C - job.min_C);
  Estimate<ExponentialFit> estimate;
  const bool search = job.options.method == "epgs";
  if (search) {
    estimate =
        estimate_exponential(job.problem, low_C, high_C, search_options(job, exponential_search_options()));
  } else {
    estimate.fit = fit_exponential(job.problem, low_C, high_C);
  }
  return {to_joint_side(estimate.fit, job.options.gear_ratio), source_stribeck_shape(job.options.gear_ratio),
          make_record(job, estimate.fit, search ? &estimate.search : nullptr)};
}

FuzzyFrictionRecord fit_fuzzy_model(const Job& job) {
  Estimate<FuzzyFit> estimate;
  const bool search = job.options.method == "epgs";
  if (search) {
    MembershipBox box;
    box.center_min_C = job.min_C - 5.0;
    box.center_max_C = job.max_C + 5.0;
    estimate =
        estimate_fuzzy(job.problem, job.options.rules, box, search_options(job, fuzzy_search_options()));
  } else {
    const Memberships memberships = graded_memberships(job.options.rules, job.min_C, job.max_C);
    estimate.fit = fit_consequents(job.problem, memberships.center_C, memberships.width_C);
  }
  return {to_joint_side(estimate.fit, job.options.gear_ratio, job.min_C, job.max_C),
          make_record(job, estimate.fit, search ? &estimate.search : nullptr)};
}

void report(const char* model, const FitRecord& fit) {
  std::printf(
      "  %-12s cost %.5f (source's, motor side, N.cm), %.5f (torque); %d generations, %lld evaluations\n",
      model, fit.cost_source, fit.cost_torque, fit.generations, static_cast<long long>(fit.evaluations));
}

// A sound catalogue's worst residual is 7 times the median one; a cell that is ten times too large makes it 18 and more.
constexpr double kOutlierRatio = 12.0;

void report_outliers(const char* model, const FitRecord& fit) {
  const std::array<const char*, 4> names{"", "static friction", "Coulomb friction", "viscous friction"};
  for (std::size_t parameter = 1; parameter < names.size(); ++parameter) {
    std::vector<double> sizes;
    for (const auto& row : fit.residuals) sizes.push_back(std::abs(row[parameter]));
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(sizes) - sizes.begin());
    const double largest = sizes[worst];
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::ranges::nth_element(sizes, middle);
    if (!(largest > kOutlierRatio * *middle)) continue;
    std::printf(
        "  %-12s WARNING: the %s at %g degC is %.3g from the fit, %.0f times the median residual: an "
        "outlier? "
        "It spoils the whole fit.\n",
        model, names[parameter], fit.residuals[worst][0], largest, largest / *middle);
  }
}

int fit(const Options& options) {
  const Job job = make_job(options);
  FrictionFile file;
  file.gear_ratio = options.gear_ratio;
  file.data_file = std::filesystem::path(options.catalogue).filename().string();
  file.data_sha256 = job.data.sha256;
  if (options.model != "fuzzy") file.exponential = fit_exponential_model(job);
  if (options.model != "exponential") file.fuzzy = fit_fuzzy_model(job);
  write_text_file(options.out, to_json(file));
  std::printf("%s: %s, minimising the %s cost%s\n", options.out.c_str(), options.method.c_str(),
              options.weighting.c_str(), options.unconstrained ? ", unconstrained" : "");
  if (!job.data.has_starting_torque)
    std::printf(
        "  no column starting_torque_Ncm: %g N.cm is taken at every temperature (--starting-torque_Ncm)\n",
        options.starting_torque_Ncm);
  if (file.exponential) report("exponential", file.exponential->fit);
  if (file.fuzzy) report("fuzzy", file.fuzzy->fit);
  if (file.exponential) report_outliers("exponential", file.exponential->fit);
  if (file.fuzzy) report_outliers("fuzzy", file.fuzzy->fit);
  return 0;
}

void add_log_options(CLI::App& command, Options& options) {
  FitLogOptions& log = options.log;
  CLI::Option* const catalogue = command.get_option("CATALOGUE");
  CLI::Option* const logs =
      command
          .add_option("--log", log.logs,
                      "instead of a catalogue: logs of strainwavectl identify, best at several temperatures")
          ->excludes(catalogue)
          ->type_name("FILE");
  const auto add = [&](const std::string& name, auto& value, const std::string& help) {
    return command.add_option(name, value, help)->needs(logs)->capture_default_str();
  };
  logs->needs(add("--prior", log.prior, "friction file of the catalogue, which the logs correct"));
  add("--joint", log.joint, "which joint, when a log holds several");
  add("--prior-common", log.weights.common,
      "relative deviation from the catalogue that all temperatures share");
  add("--prior-own", log.weights.own, "relative deviation of each temperature rule by itself");
  add("--torque-uncertainty", log.weights.torque_uncertainty, "relative deviation of the torque measurement");
  add("--confidence", log.confidence, "of the intervals");
  add("--wanted", log.wanted, "relative half width above which a temperature is called missing");
}

}  // namespace

CommandBody add_fit_command(CLI::App& app, CLI::App*& command) {
  command = app.add_subcommand("fit", "Fit friction over temperature to a catalogue, or to logs of a joint");
  const auto options = std::make_shared<Options>();
  command->add_option("CATALOGUE", options->catalogue,
                      "CSV: running torque over speed and temperature, or parameters");
  command->add_option("--model", options->model, "what to fit")
      ->check(CLI::IsMember({"exponential", "fuzzy", "both"}))
      ->capture_default_str();
  command->add_option("--method", options->method, "search, or least squares with given memberships")
      ->check(CLI::IsMember({"epgs", "least-squares"}))
      ->capture_default_str();
  command
      ->add_option("--weighting", options->weighting,
                   "what the fit minimises: error of the torque, or the source's cost")
      ->check(CLI::IsMember({"torque", "source"}))
      ->capture_default_str();
  command->add_flag("--unconstrained", options->unconstrained, "allow negative or rising friction");
  command->add_option("--seed", options->seed, "of the search; the same seed gives the same result")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "0: every core; the result does not depend on it")
      ->capture_default_str();
  command->add_option("--rules", options->rules, "number of temperature rules")->capture_default_str();
  command->add_option("--gear-ratio", options->gear_ratio, "reduction ratio")->capture_default_str();
  command
      ->add_option("--starting-torque_Ncm", options->starting_torque_Ncm,
                   "static less Coulomb friction at the motor side, where the catalogue has no column for it")
      ->capture_default_str();
  command->add_option("--out", options->out, "friction file to write (JSON)")->required();
  add_log_options(*command, *options);
  return [options] {
    options->log.out = options->out;
    if (!options->log.logs.empty()) return fit_logs(options->log);
    if (options->catalogue.empty()) throw InputError("fit: a CATALOGUE or --log FILE... is needed");
    return fit(*options);
  };
}

}  // namespace strainwave
