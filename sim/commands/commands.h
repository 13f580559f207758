// The subcommands of strainwave-sim. Each adds itself to the program; what it does runs when it was chosen.
// Offline.
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace strainwave {

void add_chapter6_command(CLI::App& program);

/// The folder `name` ("data") of the installation, or of the source tree the program was built from. Throws
/// InputError when there is neither.
std::filesystem::path shared_folder(const std::filesystem::path& name);

}  // namespace strainwave
