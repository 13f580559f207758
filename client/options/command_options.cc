// SPDX-License-Identifier: BSD-3-Clause
#include "client/options/command_options.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

CLI::Validator name_validator() {
  return {[](const std::string& name) {
            return is_valid_name(name)
                       ? std::string()
                       : "'" + name + "' is not a name: 1 to 24 of A-Z a-z 0-9 _ - are allowed, not - first";
          },
          ""};
}

CLI::Validator positive_validator(const std::string& what) {
  return {[what](const std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value);
            return good ? std::string() : "'" + text + "' is not " + what + " above 0";
          },
          ""};
}

/// States come at 10 to 200 Hz. A shorter wait would receive none and blame the daemon.
CLI::Validator time_out_validator() {
  constexpr double kShortest_s = 0.1;
  constexpr double kLongest_s = 3600.0;
  return {[](const std::string& text) {
            double value = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value >= kShortest_s && value <= kLongest_s;
            return good ? std::string() : "'" + text + "' is not a time-out: 0.1 to 3600 seconds are allowed";
          },
          ""};
}

}  // namespace

CLI::Option* add_joint(CLI::App& command, std::string& joint) {
  return command.add_option("JOINT", joint, "joint")->check(name_validator())->type_name("");
}

CLI::Option* add_joints(CLI::App& command, std::vector<std::string>& joints, const std::string& help) {
  return command.add_option("JOINT", joints, help)->check(name_validator())->type_name("");
}

CLI::Option* add_seconds(CLI::App& command, const std::string& name, double& value, const std::string& help) {
  return command.add_option(name, value, help)
      ->check(positive_validator("a time: give a number of seconds"))
      ->type_name("SECONDS");
}

CLI::Option* add_positive(CLI::App& command, const std::string& name, double& value, const std::string& type,
                          const std::string& help) {
  return command.add_option(name, value, help)->check(positive_validator("a number"))->type_name(type);
}

void add_common_options(CLI::App& app, Invocation& invocation) {
  invocation.options.all_prefixes = true;
  invocation.options.names_commands = true;
  app.add_option("--lcm-url", invocation.lcm_url, "the LCM network")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str()
      ->type_name("URL");
  app.add_option("--prefix", invocation.options.prefix,
                 "first part of the daemon's channels; without it status and watch show every daemon")
      ->check(name_validator())
      ->each([&invocation](const std::string&) { invocation.options.all_prefixes = false; })
      ->capture_default_str()
      ->type_name("NAME");
  app.add_option("--key", invocation.options.key_file, "the secret key to sign orders with (see keygen)")
      ->envname("STRAINWAVE_KEY")
      ->type_name("FILE");
  app.add_option("--timeout_s", invocation.options.timeout_s,
                 "longest wait for a state, an answer or a change of mode; does not limit --wait")
      ->check(time_out_validator())
      ->capture_default_str()
      ->type_name("SECONDS");
  app.add_flag("--json", invocation.json,
               "print JSON objects, for scripts; also of a refusal or failure, on standard error");
}

}  // namespace strainwave
