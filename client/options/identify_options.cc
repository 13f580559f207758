// SPDX-License-Identifier: BSD-3-Clause
// Options of identify.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/options/command_options.h"

namespace strainwave {

void add_identify_command(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand(
      "identify",
      "move at steady speeds in both directions, recorded for strainwave-design fit --log; Ctrl-C holds");
  auto arguments = std::make_shared<IdentifyArguments>();
  auto range = std::make_shared<std::vector<double>>();
  auto torque_Nm = std::make_shared<double>(0.0);
  add_joint(*command, arguments->joint)->required();
  command->add_option("--out", arguments->file, "the log")->required()->type_name("FILE");
  command
      ->add_option("--range_rad", *range,
                   "the joint stays between these two positions; otherwise 1 rad to either side")
      ->expected(2)
      ->type_name("FROM TO");
  add_positive(*command, "--slowest_rad_s", arguments->slowest_rad_s, "RAD/S", "the slowest speed")
      ->capture_default_str();
  add_positive(*command, "--fastest_rad_s", arguments->fastest_rad_s, "RAD/S",
               "the fastest speed; otherwise 80 % of the joint's limit");
  command
      ->add_option("--speeds", arguments->speeds,
                   "number of speeds, with a constant ratio from one to the next")
      ->check(CLI::Range(3, 50))
      ->capture_default_str();
  add_seconds(*command, "--steady_s", arguments->steady_s, "longest time at one speed in one direction")
      ->capture_default_str();
  add_positive(*command, "--max-torque_Nm", *torque_Nm, "N.M",
               "hold when the torque exceeds this; otherwise the joint's limit");
  command->add_flag("--overwrite", arguments->overwrite, "replace the file if it exists");
  command->add_flag("--dry-run", arguments->dry_run, "check and print the plan, move nothing");
  command->callback([&invocation, arguments, range, torque_Nm] {
    if (range->size() == 2) arguments->range_rad = {range->front(), range->back()};
    if (*torque_Nm > 0.0) arguments->max_torque_Nm = *torque_Nm;
    invocation.command = [arguments](Client& client, const Output& output) {
      identify(client, output, *arguments);
    };
  });
}

}  // namespace strainwave
