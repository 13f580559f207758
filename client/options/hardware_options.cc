// Options of the commands that look at hardware, without a daemon.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "client/options/command_options.h"

namespace strainwave {

namespace {

void add_check(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& help,
               void (*check)(const Output&, const std::filesystem::path&)) {
  CLI::App* command = app.add_subcommand(name, help);
  auto config = std::make_shared<std::filesystem::path>();
  command->add_option("CONFIG", *config, "the daemon's configuration file")->required()->type_name("");
  command->callback([&invocation, config, check] {
    invocation.local_command = [config, check](const Output& output) { check(output, *config); };
  });
}

}  // namespace

void add_hardware_commands(CLI::App& app, Invocation& invocation) {
  CLI::App* scan = app.add_subcommand("can-scan", "who is on a CAN bus: reads only (no daemon)");
  auto interface_name = std::make_shared<std::string>();
  scan->add_option("IFACE", *interface_name, "CAN interface, such as can0")->required()->type_name("");
  scan->callback([&invocation, interface_name] {
    invocation.local_command = [interface_name](const Output& output) { can_scan(output, *interface_name); };
  });
  add_check(app, invocation, "can-check", "do to the drives all that start-up does, enable none (no daemon)",
            can_check);
  add_check(app, invocation, "gpio-check",
            "digital lines of a configuration: level and who holds them (no daemon)", gpio_check);
}

}  // namespace strainwave
