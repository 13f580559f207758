// Man pages and shell completion of a program, from the command line that it defines: one source, so that
// they cannot drift. Not real-time.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace strainwave {

/// The page in section 1 (roff), the completion of bash, that of zsh. `program` is the name on the command
/// line.
std::string man_page(const CLI::App& app, const std::string& program);
std::string bash_completion(const CLI::App& app, const std::string& program);
std::string zsh_completion(const CLI::App& app, const std::string& program);

/// Gives `app` the hidden option --manual man|bash|zsh, which prints one of them to standard output and ends
/// the parse with success. `app` must outlive the parse.
void add_manual_option(CLI::App& app, const std::string& program);

}  // namespace strainwave
