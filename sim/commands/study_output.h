// SPDX-License-Identifier: BSD-3-Clause
// The output of a study: its summary on the screen, and a folder with a CSV file of all details, the figure and one page.
#pragma once

#include <filesystem>

#include "sim/studies/figure.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// Prints `summary`, writes <name>.csv, <name>.svg and <name>.html into the existing `directory`. Throws InputError.
void write_study(const std::string& name, const TextTable& summary, const TextTable& details,
                 const Figure& figure, const std::filesystem::path& directory);

}  // namespace strainwave
