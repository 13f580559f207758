// SPDX-License-Identifier: BSD-3-Clause
// Runs a Strainwave program that is installed beside this one. Not real-time.
#pragma once

#include <string>
#include <vector>

namespace strainwave {

/// Runs `name` with `arguments` and returns its exit status, or 128 + n after signal n. Its output goes to the output
/// of this program, or into `printed`. An interrupt of this program also ends the child. If it came before the start,
/// nothing is run and 128 + SIGTERM is returned. Throws ClientError (usage) when the program cannot be run.
int run_sibling(const std::string& name, const std::vector<std::string>& arguments,
                std::string* printed = nullptr);

}  // namespace strainwave
