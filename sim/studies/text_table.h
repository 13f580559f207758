// SPDX-License-Identifier: BSD-3-Clause
// A table of text that can be written as Markdown, CSV or HTML. Offline.
#pragma once

#include <string>
#include <vector>

namespace strainwave {

struct TextTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header

  std::string markdown() const;
  std::string csv() const;  ///< header and rows; fields contain no comma
  std::string html() const;
};

/// `value` with `digits` significant digits, or "inf" or "nan".
std::string number(double value, int digits = 4);

/// `text` with the characters that HTML reserves replaced.
std::string html_escaped(const std::string& text);

}  // namespace strainwave
