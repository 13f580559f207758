// SPDX-License-Identifier: BSD-3-Clause
// Runs a program of ours that is installed beside this one. Not real-time.
#pragma once

#include <string>
#include <vector>

namespace strainwave {

/// Runs `name` with `arguments` and returns its exit status, 128 + n after signal n. What it prints goes where ours goes, or all of it
/// into `printed`. An interrupt of this program ends it, too, also one that came before: then nothing is run, and 128 + SIGTERM is returned.
/// Throws ClientError (file) when it is not there.
int run_sibling(const std::string& name, const std::vector<std::string>& arguments,
                std::string* printed = nullptr);

}  // namespace strainwave
