// SPDX-License-Identifier: BSD-3-Clause
// Options of doctor.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/options/command_options.h"

namespace strainwave {

void add_doctor_command(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand(
      "doctor", "name what is wrong with a joint, from a short test motion or a recording; Ctrl-C holds");
  auto arguments = std::make_shared<DoctorArguments>();
  CLI::Option* joint = add_joint(*command, arguments->joint);
  CLI::Option* log =
      command->add_option("--log", arguments->log, "judge this LCM event log or flight record, move nothing")
          ->type_name("FILE");
  command
      ->add_option("--config", arguments->config,
                   "the daemon's configuration file: inertia, stiffness, delay and friction to compare with")
      ->type_name("FILE");
  add_positive(*command, "--reach_rad", arguments->reach_rad, "RAD",
               "the test motion stays within this distance of the present position")
      ->capture_default_str();
  command->add_flag("--dry-run", arguments->dry_run, "check and print the test motion, move nothing");
  command->callback([&invocation, arguments, joint, log] {
    if (joint->count() == 0 && log->count() == 0) throw CLI::RequiredError("JOINT, or --log FILE,");
    if (log->count() > 0)
      invocation.local_command = [arguments](const Output& output) { examine_log(output, *arguments); };
    else
      invocation.command = [arguments](Client& client, const Output& output) {
        examine_joint(client, output, *arguments);
      };
  });
}

}  // namespace strainwave
