#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "control/box_certificate.h"
#include "control/certificate.h"
#include "control/gain_table_json.h"
#include "design/commands.h"
#include "design/spring_options.h"
#include "design/table_report.h"

namespace strainwave {

namespace {

struct VerifyOptions {
  std::string path;
  std::string gear;
  SpringOptions spring;
};

bool verify_spring(const VerifyOptions& options, const GainTable& table) {
  const std::string gear = options.gear.empty() ? std::string(table.plant.gear.view()) : options.gear;
  const SpringVerdict verdict = judge_on_spring(table, gear, spring_request(options.spring, "verify"));
  std::fputs(verdict.text.c_str(), stdout);
  return verdict.certified;
}

ExitStatus verify(const VerifyOptions& options) {
  const GainTable table = read_gain_table(options.path);
  bool certified = true;
  for (const FeedbackGains* gains : {&table.primary, &table.fallback}) {
    const CertificateReport report = certify(*gains, table.plant, table.friction);
    certified = certified && report.certified;
    std::fputs(margins_text(*gains, report).c_str(), stdout);
  }
  if (!table.box.rigid()) {
    const BoxReport report = certify_box(table);
    certified = certified && report.certified;
    std::printf("box: %s\n  %s; %s, %d inequalities\n", describe(table.box).c_str(),
                report.certified ? "certified" : "NOT CERTIFIED", report.text.c_str(), report.inequalities);
  }
  if (options.spring.given()) certified = verify_spring(options, table) && certified;
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
                      "the gear that is its spring, by its catalogue name (default: the table's)");
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
