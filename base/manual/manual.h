// SPDX-License-Identifier: BSD-3-Clause
// Generates the man page and the shell completion of a program from its command line and its `Manual`, so that they always agree.
// Not real-time.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace strainwave {

/// Contents of a man page that the command line lacks. Each entry is a subject and a sentence without a full stop.
struct Manual {
  using Entries = std::vector<std::pair<std::string, std::string>>;

  std::string program = {};  ///< its name on the command line
  int section = 1;           ///< 8: a daemon
  Entries files = {};
  Entries examples = {};  ///< command, what it does
  std::vector<std::string> see_also = {};
  /// Completions of values with this name ("JOINT"): words, or "$(command)" that prints them.
  Entries values = {};
};

/// Numbers and meanings of the exit statuses, which all programs share.
const Manual::Entries& exit_statuses();

/// The man page (roff), the completion of bash and that of zsh.
std::string man_page(const CLI::App& app, const Manual& manual);
std::string bash_completion(const CLI::App& app, const Manual& manual);
std::string zsh_completion(const CLI::App& app, const Manual& manual);

/// Gives `app` the hidden option --manual man|bash|zsh, which prints one of them to standard output and ends
/// the parse with success. `app` must outlive the parse.
void add_manual_option(CLI::App& app, const Manual& manual);

}  // namespace strainwave
