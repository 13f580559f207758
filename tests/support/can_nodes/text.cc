// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/text.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace strainwave::can_nodes {

std::string format(const char* pattern, ...) {
  char text[256];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool numbers_of(const std::vector<std::string>& words, std::size_t count,
                std::vector<std::int64_t>& numbers) {
  if (words.size() != count + 1) return false;
  for (std::size_t i = 1; i <= count; ++i) {
    char* end = nullptr;
    numbers.push_back(std::strtoll(words[i].c_str(), &end, 0));
    if (end == words[i].c_str() || *end != '\0') return false;
  }
  return true;
}

bool number_of(const std::vector<std::string>& words, double& number) {
  if (words.size() != 2) return false;
  char* end = nullptr;
  number = std::strtod(words[1].c_str(), &end);
  return end != words[1].c_str() && *end == '\0' && std::isfinite(number);
}

bool switch_of(const std::vector<std::string>& words, bool& on) {
  on = words.size() == 2 && words[1] == "on";
  return on || (words.size() == 2 && words[1] == "off");
}

}  // namespace strainwave::can_nodes
