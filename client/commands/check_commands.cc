// SPDX-License-Identifier: BSD-3-Clause
// gpio-check and can-check: strainwaved checks the lines and drives of a configuration. No daemon has to run.
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/commands/commands.h"
#include "client/commands/sibling_program.h"
#include "client/protocol/interrupt.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

/// Runs the daemon with `arguments`. Its text goes to the terminal. For JSON output, its lines become one object.
void check(const Output& output, const std::filesystem::path& config,
           const std::vector<std::string>& arguments, const std::string& failure) {
  std::string printed;
  output.stream.flush();
  const int status = run_sibling("strainwaved", arguments, output.json ? &printed : nullptr);
  if (interrupted()) throw ClientError(ExitStatus::kInterrupted, config.string() + ": the check was stopped");
  if (output.json) {
    nlohmann::ordered_json result{{"config", config.string()}, {"passed", status == 0}};
    result["lines"] = nlohmann::ordered_json::array();
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) result["lines"].push_back(line);
    output.stream << result.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  }
  if (status != 0)
    throw ClientError(ExitStatus::kUsage,
                      config.string() + ": " + failure + (output.json ? ", see lines" : ", see above"));
}

}  // namespace

void gpio_check(const Output& output, const std::filesystem::path& config) {
  check(output, config, {"--config", config.string(), "--check-lines"}, "some digital lines cannot be used");
}

void can_check(const Output& output, const std::filesystem::path& config,
               const std::filesystem::path& data_sheet) {
  std::vector<std::string> arguments{"--config", config.string()};
  if (data_sheet.empty())
    arguments.emplace_back("--check-drives");
  else
    arguments.insert(arguments.end(), {"--check-data-sheet", data_sheet.string()});
  check(output, config, arguments, "strainwaved would refuse to start with it");
}

}  // namespace strainwave
