// SPDX-License-Identifier: BSD-3-Clause
#include "base/toml_nesting.h"

#include <algorithm>
#include <cstddef>

#include "base/input_error.h"

namespace strainwave {

namespace {

/// Length of the string with which `text` begins. A single-line string ends with its line at the latest.
std::size_t string_length(std::string_view text) {
  const char quote = text.front();
  const bool escapes = quote == '"';
  const std::string_view mark = text.substr(0, std::min<std::size_t>(3, text.size()));
  const bool many_lines = mark == "\"\"\"" || mark == "'''";
  for (std::size_t i = many_lines ? 3 : 1; i < text.size(); ++i) {
    if (escapes && text[i] == '\\') {
      ++i;
    } else if (!many_lines) {
      if (text[i] == quote) return i + 1;
      if (text[i] == '\n') return i;
    } else if (text.substr(i).starts_with(mark)) {
      // Up to two quotes next to the closing three belong to the string.
      i += 3;
      for (int own = 0; own < 2 && i < text.size() && text[i] == quote; ++own) ++i;
      return i;
    }
  }
  return text.size();
}

std::size_t comment_length(std::string_view text) {
  return std::min(text.find('\n'), text.size());
}

struct Depth {
  int dots = 0;      ///< in the key or number that is being read
  int brackets = 0;  ///< open ones

  void see(char character) {
    if (character == '.') {
      ++dots;
      return;
    }
    if (std::string_view("\n=,[]{}").find(character) != std::string_view::npos) dots = 0;
    if (character == '[' || character == '{') ++brackets;
    if (character == ']' || character == '}') brackets = std::max(0, brackets - 1);
  }
};

}  // namespace

void refuse_deep_nesting(std::string_view text, const std::string& file) {
  Depth depth;
  int line = 1;
  while (!text.empty()) {
    std::size_t length = 1;
    if (text.front() == '"' || text.front() == '\'')
      length = string_length(text);
    else if (text.front() == '#')
      length = comment_length(text);
    else
      depth.see(text.front());
    if (std::max(depth.dots, depth.brackets) > kDeepestToml)
      throw InputError(file + ":" + std::to_string(line) + ": tables are nested deeper than the allowed " +
                       std::to_string(kDeepestToml) + " levels");
    line +=
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length), '\n'));
    text.remove_prefix(length);
  }
}

}  // namespace strainwave
