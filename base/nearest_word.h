// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for mistyped words and for foreign units. Not real-time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// The word of `known` that the user most likely meant, or null. Either it differs only by a unit or last words ("speed" for
/// "speed-limit_rad_s"), or by few letters: one for each three letters typed, and at least two.
const std::string* nearest_word(std::string_view typed, const std::vector<std::string>& known);

/// How to convert a key or column whose unit the project does not use. A sentence after a space; empty for other units.
std::string unit_conversion(std::string_view key);

}  // namespace strainwave
