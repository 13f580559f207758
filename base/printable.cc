// SPDX-License-Identifier: BSD-3-Clause
#include "base/printable.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace strainwave {

namespace {

// Significant digits of computed numbers in refusals: six hide rounding errors, 17 identify any double.
constexpr int kFewestDigits = 6;
constexpr int kAllDigits = 17;

std::string in_digits(double value, int digits) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  return {text.data(), end};
}

struct Character {
  std::size_t bytes = 0;  ///< 0: not UTF-8
  std::uint32_t code = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  if (byte(0) < 0x80) return {1, byte(0)};
  const int leading_ones = std::countl_one(byte(0));
  const auto bytes = static_cast<std::size_t>(leading_ones);
  if (bytes < 2 || bytes > 4 || bytes > text.size()) return {};
  std::uint32_t code = byte(0) & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (std::countl_one(byte(i)) != 1) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kShortest{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kShortest.at(bytes) || code > 0x10FFFF || surrogate ? Character{} : Character{bytes, code};
}

struct Span {
  std::uint32_t first;
  std::uint32_t last;
};

// True for C0, DEL, C1, and characters that break lines, are invisible or change the direction of writing. These are Unicode's
// categories Cc, Zl and Zp, the invisible part of Cf, and the fillers of Hangul.
bool commands_a_terminal(std::uint32_t code) {
  constexpr std::array<Span, 12> kHidden{{{0x00, 0x1F},
                                          {0x7F, 0x9F},
                                          {0xAD, 0xAD},
                                          {0x61C, 0x61C},
                                          {0x115F, 0x1160},
                                          {0x200B, 0x200F},
                                          {0x2028, 0x202E},
                                          {0x2060, 0x206F},
                                          {0x3164, 0x3164},
                                          {0xFEFF, 0xFEFF},
                                          {0xFFA0, 0xFFA0},
                                          {0xE0000, 0xE007F}}};
  return std::any_of(kHidden.begin(), kHidden.end(),
                     [code](const Span& span) { return code >= span.first && code <= span.last; });
}

std::string made_safe(std::string_view text, bool keep_lines) {
  std::string safe;
  while (!text.empty()) {
    const Character character = first_character(text);
    const bool shown = character.bytes > 0 &&
                       (!commands_a_terminal(character.code) || (keep_lines && character.code == '\n'));
    safe += shown ? text.substr(0, character.bytes) : "?";
    text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
  }
  return safe;
}

}  // namespace

std::string printable(std::string_view text) {
  return made_safe(text.substr(0, text.find('\0')), false);
}

std::string printable_lines(std::string_view text) {
  return made_safe(text, true);
}

std::string printable_paragraph(std::string_view text) {
  std::string indented;
  for (const char letter : printable_lines(text)) {
    indented += letter;
    if (letter == '\n') indented += "  ";
  }
  return indented;
}

std::string shell_word(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,+=@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

double rounded(double value, int digits) {
  const std::string text = in_digits(value, digits);
  double read = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), read);
  return read;
}

std::string bound_text(double bound) {
  for (int digits = kFewestDigits; digits < kAllDigits; ++digits) {
    if (std::abs(rounded(bound, digits) - bound) <= 0.1 * kAtBound * std::abs(bound))
      return in_digits(bound, digits);
  }
  return number_text(bound);
}

std::string beyond_text(double value, double bound) {
  const std::string of_bound = bound_text(bound);
  for (int digits = kFewestDigits; digits < kAllDigits; ++digits)
    if (std::string text = in_digits(value, digits); text != of_bound) return text;
  return number_text(value);
}

}  // namespace strainwave
