// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/kernel_view.h"

#include <charconv>
#include <fstream>
#include <sstream>

namespace strainwave {

namespace {

/// Returns the number at the start of `text`.
std::optional<unsigned> leading_number(std::string_view text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

/// "gpiochip0: GPIOs 512-523, ..." numbers its lines from 512; "gpiochip0: 12 GPIOs, ..." numbers them from 0.
unsigned first_number(std::string_view header) {
  constexpr std::string_view kRange = ": GPIOs ";
  const std::size_t at = header.find(kRange);
  return at == std::string_view::npos ? 0 : leading_number(header.substr(at + kRange.size())).value_or(0);
}

}  // namespace

// A line of the list: " gpio-513 (direction           |strainwaved elbow   ) out hi ACTIVE LOW"
std::optional<bool> level_in_kernel_list(std::string_view text, std::string_view chip, unsigned offset) {
  std::istringstream lines{std::string(text)};
  bool inside = false;
  unsigned first = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("gpiochip")) {
      inside = line.starts_with(std::string(chip) + ":");
      first = first_number(line);
    }
    constexpr std::string_view kLine = " gpio-";
    if (!inside || !line.starts_with(kLine)) continue;
    if (leading_number(std::string_view(line).substr(kLine.size())) != first + offset) continue;
    std::istringstream words(line.substr(std::min(line.rfind(')') + 1, line.size())));
    std::string direction;
    std::string level;
    words >> direction >> level;
    if (level == "hi") return true;
    if (level == "lo") return false;
  }
  return std::nullopt;
}

std::optional<bool> level_of_held_line(std::string_view chip, unsigned offset) {
  std::ifstream file("/sys/kernel/debug/gpio");
  std::ostringstream text;
  text << file.rdbuf();
  return level_in_kernel_list(text.str(), chip, offset);
}

}  // namespace strainwave
