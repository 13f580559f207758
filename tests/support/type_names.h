// SPDX-License-Identifier: BSD-3-Clause
// Finds the types that a source tree defines at namespace level. Two types of one qualified name are an error
// that no compiler reports, and the linker chooses one of them arbitrarily.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strainwave::testing {

/// `source` without comments, literals and preprocessor lines.
std::string code_of(const std::string& source);

/// Qualified names of the classes, structs, unions and enumerations that `source` defines at namespace level,
/// except in anonymous namespaces.
std::vector<std::string> types_defined_in(const std::string& source);

/// One sentence for each qualified name that two files under `root` define.
std::vector<std::string> find_repeated_types(const std::filesystem::path& root);

}  // namespace strainwave::testing
