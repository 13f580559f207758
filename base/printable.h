// SPDX-License-Identifier: BSD-3-Clause
// Text and numbers made fit for a terminal or a log. Not real-time.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace strainwave {

/// `text` up to its first zero byte, without anything that could command a terminal, begin another line, or make it read as something else.
/// A question mark replaces control characters, invisible ones, those that turn the direction of writing, and bytes that are no UTF-8.
std::string printable(std::string_view text);

/// The same of each line of `text`: line feeds stay, and zero bytes become question marks.
std::string printable_lines(std::string_view text);

/// The same as what a program says of itself: every line but the first is indented, so that no text that was given to it can pass for
/// a line of its own.
std::string printable_paragraph(std::string_view text);

/// `word` as a shell reads it back: as it is, or in single quotes where it has a space or another character that means something there.
std::string shell_word(const std::string& word);

/// "1 knot", "2 knots". `thing`: one of them.
template <std::integral Number>
std::string counted(Number count, std::string_view thing) {
  return std::to_string(count).append(" ").append(thing).append(count == 1 ? "" : "s");
}

/// The shortest digits that read back to the same number: 0.1, -0.089, 1e-09.
std::string number_text(double value);

/// The number that `value` is with so many significant digits, 1 to 17.
double rounded(double value, int digits);

/// How near a bound a number is that was computed: one that is beyond it by no more than this share is at it.
inline constexpr double kAtBound = 1e-9;

/// A computed bound that a refusal names, in six digits or as many more as read back to it within a tenth of kAtBound: the printed number
/// itself is not beyond the bound. For a bound from a file or message, which is compared as it is, use number_text().
std::string bound_text(double bound);

/// A number that such a bound refuses, in six digits or as many more as tell it from the bound's text.
std::string beyond_text(double value, double bound);

}  // namespace strainwave
