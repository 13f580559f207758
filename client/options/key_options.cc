// SPDX-License-Identifier: BSD-3-Clause
// Options of keygen.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/options/command_options.h"

namespace strainwave {

void add_key_commands(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("keygen", "make a new key to sign orders with");
  auto arguments = std::make_shared<KeygenArguments>();
  auto role = std::make_shared<std::string>(to_text(Role::kOperator));
  command->add_option("--out", arguments->out, "the secret key; its public line goes to FILE.pub")
      ->required()
      ->type_name("FILE");
  command->add_option("--role", *role, "operator: setpoints and commands; engineer: also gain tables")
      ->check(CLI::IsMember({"operator", "engineer"}))
      ->capture_default_str();
  command->add_option("--comment", arguments->comment, "owner of the key; otherwise user@host");
  command->callback([&invocation, arguments, role] {
    arguments->role = *parse_role(*role);
    invocation.local_command = [arguments](const Output& output) { keygen(output, *arguments); };
  });
}

}  // namespace strainwave
