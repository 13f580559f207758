// SPDX-License-Identifier: BSD-3-Clause
// The types that a tree of sources defines at namespace level, by their qualified names: two of one name are an error that no
// compiler reports and that a linker settles by chance.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strainwave::testing {

/// `source` without comments, literals and lines of the preprocessor.
std::string code_of(const std::string& source);

/// Qualified names of the classes, structs, unions and enumerations that `source` defines at namespace level, anonymous
/// namespaces excepted.
std::vector<std::string> types_defined_in(const std::string& source);

/// One sentence for each qualified name that two files under `root` define.
std::vector<std::string> find_repeated_types(const std::filesystem::path& root);

}  // namespace strainwave::testing
