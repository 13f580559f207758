#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "control/input_error.h"
#include "control/text_file.h"
#include "design/catalogue.h"
#include "design/commands.h"
#include "design/friction_file.h"
#include "design/friction_fit.h"

namespace strainwave {

namespace {

struct Options {
  std::string catalogue;
  std::string out;
  std::string weighting = "torque";
  bool unconstrained = false;
  double gear_ratio = 50.0;
  double starting_torque_Ncm = 1.6;
  int rules = 5;
};

FitProblem make_problem(const FrictionData& data, const Options& options) {
  const FitWeighting weighting =
      options.weighting == "source" ? FitWeighting::kSource : FitWeighting::kTorque;
  return {fit_targets(data), friction_metric(weighting, data.motor_speeds_rpm), !options.unconstrained};
}

template <typename Fit>
FitRecord make_record(const FrictionData& data, const FitProblem& problem, const Options& options,
                      const Fit& fit) {
  FitRecord record;
  record.method = "least-squares";
  record.weighting = options.weighting;
  record.physical = problem.physical;
  record.stopped = "optimum of a linear problem";
  const FitTargets& targets = problem.targets;
  const Eigen::MatrixX3d errors = targets.parameters - predict(fit, targets.temperature_C);
  record.cost_source = metric_cost(errors, friction_metric(FitWeighting::kSource, data.motor_speeds_rpm));
  record.cost_torque = metric_cost(errors, friction_metric(FitWeighting::kTorque, data.motor_speeds_rpm));
  for (Eigen::Index k = 0; k < errors.rows(); ++k) {
    record.residuals.push_back({targets.temperature_C(k), errors(k, 0), errors(k, 1), errors(k, 2)});
  }
  return record;
}

int fit(const Options& options) {
  if (!(options.gear_ratio > 0.0))
    throw InputError("fit", "gear-ratio", std::to_string(options.gear_ratio), "must be above 0");
  if (!(options.starting_torque_Ncm >= 0.0))
    throw InputError("fit: starting-torque_Ncm: must not be negative");
  if (options.rules < 2 || options.rules > kMaxTemperatureRules) {
    throw InputError("fit", "rules", std::to_string(options.rules),
                     "must be from 2 to " + std::to_string(kMaxTemperatureRules));
  }
  const FrictionData data = read_catalogue(options.catalogue, options.starting_torque_Ncm);
  const FitProblem problem = make_problem(data, options);
  const double min_C = data.points.front().temperature_C;
  const double max_C = data.points.back().temperature_C;

  FrictionFile file;
  file.gear_ratio = options.gear_ratio;
  file.data_file = std::filesystem::path(options.catalogue).filename().string();
  file.data_sha256 = data.sha256;
  const ExponentialFit exponential = fit_exponential(problem, 1.0, 10.0 * (max_C - min_C));
  file.exponential = ExponentialFriction{to_joint_side(exponential, options.gear_ratio),
                                         source_stribeck_shape(options.gear_ratio),
                                         make_record(data, problem, options, exponential)};
  const Memberships memberships = graded_memberships(options.rules, min_C, max_C);
  const FuzzyFit fuzzy = fit_consequents(problem, memberships.center_C, memberships.width_C);
  file.fuzzy = FuzzyFrictionRecord{to_joint_side(fuzzy, options.gear_ratio, min_C, max_C),
                                   make_record(data, problem, options, fuzzy)};
  write_text_file(options.out, to_json(file));
  std::printf("%s: exponential law, cost %.4f; %d fuzzy rules, cost %.4f (source's cost, motor side, N.cm)\n",
              options.out.c_str(), file.exponential->fit.cost_source, options.rules,
              file.fuzzy->fit.cost_source);
  return 0;
}

}  // namespace

Action add_fit_command(CLI::App& app, CLI::App*& command) {
  command = app.add_subcommand("fit", "Fit friction over temperature to a catalogue");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("CATALOGUE", options->catalogue,
                   "CSV: running torque over speed and temperature, or parameters")
      ->required();
  command
      ->add_option("--weighting", options->weighting,
                   "what the fit minimises: error of the torque, or the source's cost")
      ->check(CLI::IsMember({"torque", "source"}))
      ->capture_default_str();
  command->add_flag("--unconstrained", options->unconstrained, "allow negative or rising friction");
  command->add_option("--rules", options->rules, "number of temperature rules")->capture_default_str();
  command->add_option("--gear-ratio", options->gear_ratio, "reduction ratio")->capture_default_str();
  command
      ->add_option("--starting-torque_Ncm", options->starting_torque_Ncm,
                   "static less Coulomb friction at the motor side, where the catalogue has no column for it")
      ->capture_default_str();
  command->add_option("--out", options->out, "friction file to write (JSON)")->required();
  return [options] { return fit(*options); };
}

}  // namespace strainwave
