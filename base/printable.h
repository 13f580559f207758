// SPDX-License-Identifier: BSD-3-Clause
// Makes text and numbers safe and readable for a terminal or a log. Not real-time.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace strainwave {

/// `text` up to its first zero byte. The result cannot control a terminal, begin another line or pass for other text. A question mark
/// replaces control characters, invisible ones, those that change the direction of writing, and bytes that are not UTF-8.
std::string printable(std::string_view text);

/// The same for all lines of `text`: line feeds stay, and zero bytes become question marks.
std::string printable_lines(std::string_view text);

/// The same for a program's messages: every line but the first is indented, so that quoted input cannot pass for a message of
/// the program.
std::string printable_paragraph(std::string_view text);

/// `word` for a shell: unchanged, or in single quotes if it is empty or has a character that may be special there.
std::string shell_word(const std::string& word);

/// "1 knot", "2 knots". `thing`: the singular.
template <std::integral Number>
std::string counted(Number count, std::string_view thing) {
  return std::to_string(count).append(" ").append(thing).append(count == 1 ? "" : "s");
}

/// The shortest digits that read back to the same number: 0.1, -0.089, 1e-09.
std::string number_text(double value);

/// `value` rounded to `digits` significant digits, 1 to 17.
double rounded(double value, int digits);

/// Relative tolerance of computed numbers: one that exceeds its bound by at most this share counts as at the bound.
inline constexpr double kAtBound = 1e-9;

/// Text of a computed bound in a refusal. It has six digits, or as many more as keep it within a tenth of kAtBound, so that the printed
/// number is itself allowed. A bound from a file or message is compared exactly; use number_text() for it.
std::string bound_text(double bound);

/// Text of a number that exceeds such a bound. It has six digits, or as many more as distinguish it from the bound's text.
std::string beyond_text(double value, double bound);

}  // namespace strainwave
