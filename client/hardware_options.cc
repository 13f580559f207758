// Options of the commands that look at hardware, without a daemon: gpio-check.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/command_options.h"

namespace strainwave {

void add_hardware_commands(CLI::App& app, Invocation& invocation) {
  CLI::App* lines = app.add_subcommand("gpio-check", "digital lines of a configuration: level and who holds them");
  auto config = std::make_shared<std::filesystem::path>();
  lines->add_option("CONFIG", *config, "the daemon's configuration file")->required()->type_name("");
  lines->callback([&invocation, config] {
    invocation.local_command = [config](const Output& output) { gpio_check(output, *config); };
  });
}

}  // namespace strainwave
