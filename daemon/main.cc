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

namespace {

strainwave::ExitStatus as_status(bool good) {
  return good ? strainwave::ExitStatus::kDone : strainwave::ExitStatus::kRefused;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Real-time control of strain-wave joints whose friction changes with temperature."};
  std::string config_path;
  bool check_only = false;
  app.add_option("--config", config_path, "configuration file (TOML)")->required();
  app.add_flag("--check", check_only,
               "load every file, report whether the daemon would start here, and exit");
  bool check_lines = false;
  app.add_flag("--check-lines", check_lines,
               "list the digital lines of all joints with their holders, and exit");
  bool check_drives = false;
  app.add_flag("--check-drives", check_drives,
               "set up and check the drives as at start-up, enable none, and exit");
  std::string data_sheet;
  app.add_option(
      "--check-data-sheet", data_sheet,
      "run start-up against a CANopen drive's electronic data sheet (EDS) instead of the drive, and exit");
  std::string commissioned;
  CLI::Option* const commission = app.add_option(
      "--commission", commissioned, "move this joint inside its limits to learn what it is, and exit");
  std::string directory;
  CLI::Option* const out =
      app.add_option("--out", directory, "folder for commission.json, what --commission found");
  commission->needs(out);
  out->needs(commission);
  std::string gateway_socket;
  app.add_option(
      "--gateway-socket", gateway_socket,
      "let the service manager start the gateway, as a user of its own, by a connection to this socket");
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
                     "measure the joint elbow; a key ends it, and a later run goes on"},
                    {"strainwaved --config strainwaved.toml",
                     "run until a signal; every joint comes to rest before the end"}},
       .see_also = {"strainwavectl(1)", "strainwave-telemetry(8)", "strainwave-design(1)"}});
  // A log that may not grow or has lost its reader is no reason to end.
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
  return strainwave::run_program(app, argc, argv, [&] {
    const bool drives_alone = check_lines || check_drives || !data_sheet.empty() || !commissioned.empty();
    strainwave::DaemonConfig config =
        strainwave::read_config(config_path, !commissioned.empty() ? strainwave::ConfigUse::kCommission
                                             : drives_alone        ? strainwave::ConfigUse::kCheckDrives
                                                                   : strainwave::ConfigUse::kRun);
    config.gateway_socket = gateway_socket;
    if (drives_alone)
      for (const std::string& warning : config.warnings)
        std::cout << "warning: " << strainwave::printable_paragraph(warning) << '\n';
    if (check_only) {
      strainwave::check_start(config, std::cout);
      std::cout << strainwave::printable(config_path) << ": OK ("
                << strainwave::counted(config.joints.size(), "joint") << ", prefix " << config.prefix
                << ")\n";
      return strainwave::ExitStatus::kDone;
    }
    if (check_lines) return as_status(strainwave::check_lines(config, std::cout));
    if (!data_sheet.empty()) return as_status(strainwave::check_data_sheet(config, data_sheet, std::cout));
    if (check_drives) return as_status(strainwave::check_drives(config, std::cout));
    if (!commissioned.empty())
      return strainwave::commission_joint(config, config_path, commissioned, directory, std::cout);
    strainwave::start_logging();
    strainwave::Supervisor supervisor(config);
    supervisor.run();
    return strainwave::ExitStatus::kDone;
  });
}
