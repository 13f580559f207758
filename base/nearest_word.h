// SPDX-License-Identifier: BSD-3-Clause
// The allowed word that a user most likely meant, and the unit. Not real-time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// The word of `known` that `typed` most likely was to be: the same without its unit or last words ("speed" for "speed-limit_rad_s"), or
/// few slips of the pen away (one for three letters, two at least). Null when none is.
const std::string* nearest_word(std::string_view typed, const std::vector<std::string>& known);

/// How to convert what a key or column in a unit that is not used here gives, as a sentence behind a space; empty for any other.
std::string unit_conversion(std::string_view key);

}  // namespace strainwave
