#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "control/certificate.h"
#include "control/gain_table_json.h"
#include "design/commands.h"
#include "design/table_report.h"

namespace strainwave {

namespace {

int verify(const std::string& path) {
  const GainTable table = read_gain_table(path);
  bool certified = true;
  for (const FeedbackGains* gains : {&table.primary, &table.fallback}) {
    const CertificateReport report = certify(*gains, table.plant, table.friction);
    certified = certified && report.certified;
    std::fputs(margins_text(*gains, report).c_str(), stdout);
  }
  std::printf("%s: %s\n", path.c_str(), certified ? "certified" : "NOT CERTIFIED");
  return certified ? 0 : 1;
}

}  // namespace

CommandBody add_verify_command(CLI::App& app, CLI::App*& command) {
  command = app.add_subcommand("verify", "Prove that a table's gains are stable; exit status 0 or 1");
  const auto path = std::make_shared<std::string>();
  command->add_option("TABLE", *path, "gain table (JSON)")->required();
  return [path] { return verify(*path); };
}

CommandBody add_show_command(CLI::App& app, CLI::App*& command) {
  command = app.add_subcommand("show", "Describe a table");
  const auto path = std::make_shared<std::string>();
  command->add_option("TABLE", *path, "gain table (JSON)")->required();
  return [path] {
    std::fputs(description(read_gain_table(*path)).c_str(), stdout);
    return 0;
  };
}

}  // namespace strainwave
