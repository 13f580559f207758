// SPDX-License-Identifier: BSD-3-Clause
// strainwaved: the real-time control daemon. `strainwaved --config FILE`; see docs/configuration.md.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "base/manual/command_line.h"
#include "base/printable.h"
#include "daemon/commission/commission.h"
#include "daemon/config/config.h"
#include "daemon/drive_check.h"
#include "daemon/log.h"
#include "daemon/start_check.h"
#include "daemon/supervisor.h"

namespace strainwave {
namespace {

struct Arguments {
  std::string config;
  bool check = false;
  bool check_lines = false;
  bool check_drives = false;
  std::string data_sheet;
  std::string commissioned;
  std::string directory;
  std::string gateway_socket;

  bool drives_alone() const {
    return check_lines || check_drives || !data_sheet.empty() || !commissioned.empty();
  }
};

void add_options(CLI::App& app, Arguments& arguments) {
  app.add_option("--config", arguments.config, "configuration file (TOML)")->required();
  app.add_flag("--check", arguments.check,
               "load every file, report whether the daemon would start here, and exit");
  app.add_flag("--check-lines", arguments.check_lines,
               "list the digital lines of all joints with their holders, and exit");
  app.add_flag("--check-drives", arguments.check_drives,
               "set up and check the drives as at start-up, enable none, and exit");
  app.add_option(
      "--check-data-sheet", arguments.data_sheet,
      "run start-up against a CANopen drive's electronic data sheet (EDS) instead of the drive, and exit");
  CLI::Option* const commission = app.add_option("--commission", arguments.commissioned,
                                                 "move this joint inside its limits to measure it, and exit");
  CLI::Option* const out =
      app.add_option("--out", arguments.directory, "folder for commission.json, the result of --commission");
  commission->needs(out);
  out->needs(commission);
  app.add_option("--gateway-socket", arguments.gateway_socket,
                 "socket of the service manager, which starts the gateway as a user of its own");
}

ExitStatus as_status(bool good) {
  return good ? ExitStatus::kDone : ExitStatus::kRefused;
}

ExitStatus run(const Arguments& arguments) {
  const ConfigUse use = !arguments.commissioned.empty() ? ConfigUse::kCommission
                        : arguments.drives_alone()      ? ConfigUse::kCheckDrives
                                                        : ConfigUse::kRun;
  DaemonConfig config = read_config(arguments.config, use);
  config.gateway_socket = arguments.gateway_socket;
  if (arguments.drives_alone())
    for (const std::string& warning : config.warnings)
      std::cout << "warning: " << printable_paragraph(warning) << '\n';
  if (arguments.check) {
    check_start(config, std::cout);
    std::cout << printable(arguments.config) << ": OK (" << counted(config.joints.size(), "joint")
              << ", prefix " << config.prefix << ")\n";
    return ExitStatus::kDone;
  }
  if (arguments.check_lines) return as_status(check_lines(config, std::cout));
  if (!arguments.data_sheet.empty())
    return as_status(check_data_sheet(config, arguments.data_sheet, std::cout));
  if (arguments.check_drives) return as_status(check_drives(config, std::cout));
  if (!arguments.commissioned.empty())
    return commission_joint(config, arguments.config, arguments.commissioned, arguments.directory, std::cout);
  start_logging();
  Supervisor supervisor(config);
  supervisor.run();
  return ExitStatus::kDone;
}

}  // namespace
}  // namespace strainwave

int main(int argc, char** argv) {
  CLI::App app{"Real-time control of strain-wave joints whose friction changes with temperature."};
  strainwave::Arguments arguments;
  strainwave::add_options(app, arguments);
  strainwave::configure_program(
      app,
      {.program = "strainwaved",
       .section = 8,
       .files = {{"/etc/strainwave/strainwaved.toml", "the service's configuration"},
                 {"/etc/strainwave/authorized_keys", "the public keys that may give orders"},
                 {"/var/lib/strainwave/", "flight records"},
                 {"/usr/share/doc/strainwave/config/reference.toml", "every key of a configuration"}},
       .examples = {{"strainwaved --config strainwaved.toml --check", "whether it would start, and why not"},
                    {"strainwaved --config strainwaved.toml --commission elbow --out elbow",
                     "measure the joint elbow; a key ends the run, and a later run continues"},
                    {"strainwaved --config strainwaved.toml",
                     "run until a signal; every joint comes to rest before the end"}},
       .see_also = {"strainwavectl(1)", "strainwave-telemetry(8)", "strainwave-design(1)"}});
  // A log file at its size limit, or a log without a reader, must not end the daemon.
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
  return strainwave::run_program(app, argc, argv, [&] { return strainwave::run(arguments); });
}
