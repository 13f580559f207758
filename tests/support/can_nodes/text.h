// SPDX-License-Identifier: BSD-3-Clause
// Text of the nodes' records and commands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave::can_nodes {

/// Formats like printf, up to 255 characters. The compiler checks the arguments against the pattern.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

std::vector<std::string> words_of(std::string_view line);

/// Whether `words` are a verb and `count` whole numbers in C's notation, which are then appended to `numbers`.
bool numbers_of(const std::vector<std::string>& words, std::size_t count, std::vector<std::int64_t>& numbers);

/// Whether `words` are a verb and one finite number.
bool number_of(const std::vector<std::string>& words, double& number);

/// Whether `words` are a verb and "on" or "off".
bool switch_of(const std::vector<std::string>& words, bool& on);

}  // namespace strainwave::can_nodes
