// can-scan and can-check: drives on CAN without a running daemon.
#include "client/commands/commands.h"
#include "client/commands/sibling_program.h"
#include "client/link/exit_status.h"
#include "drivers/can/can_scan.h"

namespace strainwave {

void can_scan(const Output& output, const std::string& interface_name) {
  scan_can_interface(interface_name, output.stream);
}

void can_check(const Output& output, const std::filesystem::path& config,
               const std::filesystem::path& data_sheet) {
  output.stream.flush();
  std::vector<std::string> arguments{"--config", config.string()};
  if (data_sheet.empty())
    arguments.emplace_back("--check-drives");
  else
    arguments.insert(arguments.end(), {"--check-data-sheet", data_sheet.string()});
  if (run_sibling("strainwaved", arguments) != 0)
    throw ClientError(ExitStatus::kUsage, config.string() + ": start-up would refuse it, see above");
}

}  // namespace strainwave
