// SPDX-License-Identifier: BSD-3-Clause
// The parts of a command line that users see. Not real-time.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace strainwave {

/// Options and commands without the hidden ones.
std::vector<const CLI::Option*> shown_options(const CLI::App& app);
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// "-h", "--help": every way to write it; none for a positional.
std::vector<std::string> spellings(const CLI::Option& option);

}  // namespace strainwave
