// SPDX-License-Identifier: BSD-3-Clause
// Options of the commands for hardware, which need no daemon.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "client/options/command_options.h"

namespace strainwave {

namespace {

std::shared_ptr<std::filesystem::path> add_config(CLI::App& command) {
  auto config = std::make_shared<std::filesystem::path>();
  command.add_option("CONFIG", *config, "the daemon's configuration file")->required()->type_name("");
  return config;
}

void add_can_check(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("can-check", "set up and check the drives as at start-up, enable none (no daemon)");
  const auto config = add_config(*command);
  auto data_sheet = std::make_shared<std::filesystem::path>();
  command
      ->add_option("--eds", *data_sheet, "electronic data sheet (EDS) to check against instead of the drives")
      ->type_name("FILE");
  command->callback([&invocation, config, data_sheet] {
    invocation.local_command = [config, data_sheet](const Output& output) {
      can_check(output, *config, *data_sheet);
    };
  });
}

void add_gpio_check(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand(
      "gpio-check", "show the digital lines of a configuration: level and holder (no daemon)");
  const auto config = add_config(*command);
  command->callback([&invocation, config] {
    invocation.local_command = [config](const Output& output) { gpio_check(output, *config); };
  });
}

void add_commission(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand(
      "commission",
      "measure a joint, design its gain table and write its configuration (no daemon); Ctrl-C stops it");
  auto arguments = std::make_shared<CommissionArguments>();
  add_joint(*command, arguments->joint)->required();
  command->add_option("--config", arguments->config, "the daemon's configuration file, which is not changed")
      ->required()
      ->type_name("FILE");
  command->add_option("--out", arguments->out, "folder for the results; what it has already is kept")
      ->required()
      ->type_name("DIR");
  command->callback([&invocation, arguments] {
    invocation.local_command = [arguments](const Output& output) { commission(output, *arguments); };
  });
}

}  // namespace

void add_hardware_commands(CLI::App& app, Invocation& invocation) {
  CLI::App* scan = app.add_subcommand("can-scan", "list the nodes of a CAN bus; reads only (no daemon)");
  auto interface_name = std::make_shared<std::string>();
  scan->add_option("IFACE", *interface_name, "CAN interface, such as can0")->required()->type_name("");
  scan->callback([&invocation, interface_name] {
    invocation.local_command = [interface_name](const Output& output) { can_scan(output, *interface_name); };
  });
  add_can_check(app, invocation);
  add_gpio_check(app, invocation);
  add_commission(app, invocation);
}

}  // namespace strainwave
