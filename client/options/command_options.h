// SPDX-License-Identifier: BSD-3-Clause
// The commands of strainwavectl as options of CLI11, one function per family, and shared options. Each
// function adds its commands to the command line. The chosen command stores its action in the Invocation. Not
// real-time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/manual/manual.h"
#include "client/commands/commands.h"
#include "lcmtypes/multicast_check.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace strainwave {

/// The request of the command line.
struct Invocation {
  std::string lcm_url = kUsualLcmUrl;
  ClientOptions options;
  bool json = false;
  std::function<void(Client&, const Output&)> command;
  std::function<void(const Output&)> local_command;  ///< instead of `command`: needs neither LCM nor a daemon
};

/// The parts of the man page and the completion that the command line does not contain.
Manual manual_of_strainwavectl();

/// Options for all commands, then the families in the order of the help.
void add_common_options(CLI::App& app, Invocation& invocation);
void add_observing_commands(CLI::App& app, Invocation& invocation);  ///< status, timing, watch
void add_order_commands(CLI::App& app, Invocation& invocation);      ///< enable ... load-table
void add_identify_command(CLI::App& app, Invocation& invocation);
void add_doctor_command(CLI::App& app, Invocation& invocation);
void add_log_commands(CLI::App& app, Invocation& invocation);       ///< record, export, play, plot-record
void add_key_commands(CLI::App& app, Invocation& invocation);       ///< keygen
void add_hardware_commands(CLI::App& app, Invocation& invocation);  ///< can-scan ... commission

// Options that several commands have. The value is checked before the command runs.
CLI::Option* add_joint(CLI::App& command, std::string& joint);
CLI::Option* add_joints(CLI::App& command, std::vector<std::string>& joints, const std::string& help);
CLI::Option* add_seconds(CLI::App& command, const std::string& name, double& value, const std::string& help);
/// A finite number above 0 with its unit's name in `type`.
CLI::Option* add_positive(CLI::App& command, const std::string& name, double& value, const std::string& type,
                          const std::string& help);

}  // namespace strainwave
