// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <memory>

#include "base/input_error.h"
#include "design/commands.h"
#include "design/fit_catalogue_command.h"
#include "design/fit_log_command.h"
#include "design/fit_record_command.h"

namespace strainwave {

namespace {

struct FitOptions {
  std::string catalogue;
  std::string out;
  FitCatalogueOptions fit;
  FitLogOptions log;
  FitRecordOptions record;
};

void add_log_options(CLI::App& command, FitOptions& options) {
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
  add("--joint", log.joint, "the joint, where a log holds several");
  add("--prior-common", log.weights.common,
      "relative deviation from the catalogue that all temperatures share");
  add("--prior-own", log.weights.own, "relative deviation of each temperature rule by itself");
  add("--torque-uncertainty", log.weights.torque_uncertainty, "relative deviation of the torque measurement");
  add("--confidence", log.confidence, "confidence level of the intervals");
  add("--wanted", log.wanted, "relative half width above which a temperature is called missing");
}

void add_record_options(CLI::App& command, FitOptions& options) {
  CLI::Option* const record =
      command
          .add_option("--record", options.record.record,
                      "instead of a catalogue: commission.json of strainwavectl commission")
          ->excludes(command.get_option("CATALOGUE"))
          ->excludes(command.get_option("--log"))
          ->type_name("FILE");
  record->needs(command
                    .add_option("--gear", options.record.gear,
                                "with --record: the joint's gear, whose friction the record corrects")
                    ->needs(record));
  command
      .add_option("--joint-model", options.record.joint_model,
                  "with --record: identity of the joint (default: the gear's name; rhs17-6006 for csf-17-50)")
      ->needs(record);
}

ExitStatus fit(FitOptions& options) {
  options.record.out = options.log.out = options.fit.out = options.out;
  options.fit.catalogue = options.catalogue;
  if (!options.record.record.empty()) return fit_record(options.record);
  if (!options.log.logs.empty()) return fit_logs(options.log);
  if (options.catalogue.empty())
    throw InputError("fit: a CATALOGUE, --log FILE... or --record FILE is needed");
  return fit_catalogue(options.fit);
}

}  // namespace

void add_fit_command(CLI::App& program, CommandBody& chosen) {
  CLI::App* command = program.add_subcommand(
      "fit", "Fit friction over temperature to a catalogue, or to logs or the commissioning of a joint");
  const auto options = std::make_shared<FitOptions>();
  command->add_option("CATALOGUE", options->catalogue,
                      "CSV: running torque over speed and temperature, or parameters");
  command->add_option("--model", options->fit.model, "what to fit")
      ->check(CLI::IsMember({"exponential", "fuzzy", "both"}))
      ->capture_default_str();
  command->add_option("--method", options->fit.method, "search, or least squares with given memberships")
      ->check(CLI::IsMember({"epgs", "least-squares"}))
      ->capture_default_str();
  command
      ->add_option("--weighting", options->fit.weighting,
                   "what the fit minimises: error of the torque, or the cost of Zhao (2006)")
      ->check(CLI::IsMember({"torque", "source"}))
      ->capture_default_str();
  command
      ->add_option("--non-increasing", options->fit.non_increasing,
                   "what must not rise with temperature: the whole curve, or only the rules' friction")
      ->check(CLI::IsMember({"curve", "rules"}))
      ->capture_default_str();
  command
      ->add_option(
          "--rules-from", options->fit.rules_from,
          "what the fuzzy rules follow; auto: the data if there are at least two temperatures per rule")
      ->check(CLI::IsMember({"auto", "data", "exponential"}))
      ->capture_default_str();
  command
      ->add_option("--outliers", options->fit.outliers,
                   "temperatures without which the others fit six times better: keep or leave out")
      ->check(CLI::IsMember({"keep", "leave-out"}))
      ->capture_default_str();
  command->add_flag("--unconstrained", options->fit.unconstrained, "allow negative or rising friction");
  command->add_option("--seed", options->fit.seed, "seed of the search; the same seed gives the same result")
      ->capture_default_str();
  command->add_option("--threads", options->fit.threads, "0: every core; the result does not depend on it")
      ->capture_default_str();
  command->add_option("--rules", options->fit.rules, "number of temperature rules")->capture_default_str();
  command->add_option("--gear-ratio", options->fit.gear_ratio, "reduction ratio")->capture_default_str();
  command->add_option("--starting-torque_Ncm", options->fit.starting_torque_Ncm,
                      "starting (breakaway) torque at the motor side at 25 degC, where the catalogue has no "
                      "column for it; otherwise static friction is 1.6 N.cm above Coulomb friction");
  command->add_option("--out", options->out, "friction file to write (JSON)")->required();
  add_log_options(*command, *options);
  add_record_options(*command, *options);
  command->callback([&chosen, options] { chosen = [options] { return fit(*options); }; });
}

}  // namespace strainwave
