// SPDX-License-Identifier: BSD-3-Clause
// How deep a TOML text nests, before anything that recurses sees it: toml++ bounds the values in each other, but makes a table for
// every dot of a key, and destroys tables by recursion. Not real-time.
#pragma once

#include <string>
#include <string_view>

namespace strainwave {

/// Dots of one key, and brackets in each other: of both, more than any file of ours has.
inline constexpr int kDeepestToml = 32;

/// Throws InputError that names `file` and the line where a key has more dots, or brackets lie deeper in each other, than
/// kDeepestToml. Strings and comments do not count. Text that is no TOML is left to its parser, which ends where it ceases to be.
void refuse_deep_nesting(std::string_view text, const std::string& file);

}  // namespace strainwave
