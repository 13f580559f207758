// SPDX-License-Identifier: BSD-3-Clause
// Checks how deep a TOML text nests before toml++ parses it. The parser limits nested values, but it makes a table for every dot of a key,
// and destroys tables recursively. Not real-time.
#pragma once

#include <string>
#include <string_view>

namespace strainwave {

/// Limit of the dots in one key and of nested brackets. No file of the project reaches it.
inline constexpr int kDeepestToml = 32;

/// Throws InputError that names `file` and the line where a key has more than kDeepestToml dots, or brackets nest deeper.
/// Strings and comments do not count. Invalid TOML is left to the parser, which stops at the first error.
void refuse_deep_nesting(std::string_view text, const std::string& file);

}  // namespace strainwave
