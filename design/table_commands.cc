// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "base/input_error.h"
#include "control/table/box_certificate.h"
#include "control/table/gain_table_json.h"
#include "design/commands.h"
#include "design/exact/exact_certificate.h"
#include "design/gains/table_reach.h"
#include "design/joint_defaults.h"
#include "design/spring_options.h"
#include "design/table_report.h"

namespace strainwave {

namespace {

struct VerifyOptions {
  std::string path;
  std::string gear;
  bool exact = false;
  SpringOptions spring;
};

std::string gear_of(const VerifyOptions& options, const GainTable& table) {
  return options.gear.empty() ? std::string(table.plant.gear.view()) : options.gear;
}

// The given inertia, else that of the table's box, else of the catalogue's actuator. Prints one that is not given.
BoxRange motor_inertia_kgm2(const VerifyOptions& options, const GainTable& table) {
  if (const auto given = given_motor_inertia(options.spring, "verify")) return *given;
  const BoxRange& of_box = table.box.motor_inertia_kgm2;
  if (!table.box.rigid()) {
    std::printf("--motor-inertia_kgm2 %g..%g, of the table's box\n", of_box.from, of_box.to);
    return of_box;
  }
  const MotorInertia inertia = usual_motor_inertia("verify", find_gear(gear_of(options, table)),
                                                   std::string(table.plant.joint_model.view()), std::nullopt);
  std::printf("--motor-inertia_kgm2 %g, %s\n", inertia.at_joint_kgm2, inertia.origin.c_str());
  return {inertia.at_joint_kgm2, inertia.at_joint_kgm2};
}

/// The requested spring, if any. Throws InputError.
std::optional<SpringRequest> requested_spring(const VerifyOptions& options, const GainTable& table) {
  if (!options.spring.given()) {
    if (!options.gear.empty())
      throw InputError("verify", "--gear", options.gear,
                       "is for a joint with a spring: give --load-inertia_kgm2 as well, or leave --gear out");
    return std::nullopt;
  }
  SpringRequest request = spring_request(options.spring, "verify", motor_inertia_kgm2(options, table));
  (void)spring_box(table.friction, gear_of(options, table), request.motor_inertia_kgm2,
                   request.link_inertia_kgm2);
  return request;
}

bool verify_spring(const GainTable& table, const std::string& gear, const SpringRequest& request) {
  const SpringVerdict verdict = judge_on_spring(table, gear, request);
  std::fputs(verdict.text.c_str(), stdout);
  return verdict.certified;
}

bool verify_exactly(const GainTable& table) {
  const ExactReport report = certify_exactly(table);
  if (report.certified) {
    std::printf("in rational numbers: certified, %d inequalities\n", report.inequalities);
  } else {
    std::printf("in rational numbers: NOT CERTIFIED: %s\n", report.refusal.c_str());
  }
  return report.certified;
}

ExitStatus verify(const VerifyOptions& options) {
  const GainTable table = read_gain_table(options.path);
  // Wrong options are refused before any verdict is printed.
  const std::optional<SpringRequest> spring = requested_spring(options, table);
  const BoxReport report = certify_box(table);
  bool certified = report.certified;
  std::printf("box: %s\n  %s; %s, %d inequalities\n", describe(table.box).c_str(),
              report.certified ? "certified" : "NOT CERTIFIED", report.text.c_str(), report.inequalities);
  if (report.certified) std::fputs(stiffness_text(table.box).c_str(), stdout);
  if (report.certified) std::fputs(describe(reach_of(table), table.torque_limit_Nm).c_str(), stdout);
  if (table.primary.has_integrator != 0 && !proves_slow_part(table.primary, table.plant)) {
    std::printf("NOT CERTIFIED: P of rule 0, which the anti-windup uses, does not fall\n");
    certified = false;
  }
  if (options.exact) certified = verify_exactly(table) && certified;
  if (spring) certified = verify_spring(table, gear_of(options, table), *spring) && certified;
  std::printf("%s: %s\n", options.path.c_str(), certified ? "certified" : "NOT CERTIFIED");
  return certified ? ExitStatus::kDone : ExitStatus::kRefused;
}

ExitStatus show(const std::string& path) {
  std::fputs(description(read_gain_table(path)).c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace

void add_verify_command(CLI::App& program, CommandBody& chosen) {
  CLI::App* command =
      program.add_subcommand("verify", "Prove that a table's gains are stable; exit status 0 or 1");
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("TABLE", options->path, "gain table (JSON)")->required();
  command->add_option("--gear", options->gear,
                      "the gear whose spring the joint has, by its catalogue name (default: the table's)");
  command->add_flag("--exact", options->exact,
                    "prove the table a second time, by other code and without rounding; up to a minute");
  add_spring_options(*command, options->spring);
  command->callback([&chosen, options] { chosen = [options] { return verify(*options); }; });
}

void add_show_command(CLI::App& program, CommandBody& chosen) {
  CLI::App* command = program.add_subcommand("show", "Describe a table");
  const auto path = std::make_shared<std::string>();
  command->add_option("TABLE", *path, "gain table (JSON)")->required();
  command->callback([&chosen, path] { chosen = [path] { return show(*path); }; });
}

}  // namespace strainwave
