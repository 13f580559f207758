// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/text_table.h"

#include <array>
#include <cassert>
#include <cstdio>

namespace strainwave {

namespace {

std::string joined(const std::vector<std::string>& fields, const std::string& before,
                   const std::string& between, const std::string& after) {
  std::string line = before;
  for (std::size_t i = 0; i < fields.size(); ++i) line += (i == 0 ? "" : between) + fields[i];
  return line + after;
}

std::vector<std::string> escaped(std::vector<std::string> fields) {
  for (std::string& field : fields) field = html_escaped(field);
  return fields;
}

/// Escapes each bar, because a bar within a field would end its cell.
std::vector<std::string> of_markdown(std::vector<std::string> fields) {
  for (std::string& field : fields)
    for (std::size_t at = 0; (at = field.find('|', at)) != std::string::npos; at += 2) field.insert(at, "\\");
  return fields;
}

}  // namespace

std::string number(double value, int digits) {
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value + 0.0);  // + 0.0 makes -0 a plain 0
  return buffer.data();
}

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string TextTable::markdown() const {
  std::string text = title.empty() ? "" : "### " + title + "\n\n";
  text += joined(of_markdown(header), "| ", " | ", " |\n");
  text += joined(std::vector<std::string>(header.size(), "---"), "|", "|", "|\n");
  for (const auto& row : rows) text += joined(of_markdown(row), "| ", " | ", " |\n");
  return text + "\n";
}

std::string TextTable::csv() const {
  std::string text = joined(header, "", ",", "\n");
  for (const auto& row : rows) {
    assert(row.size() == header.size());
    text += joined(row, "", ",", "\n");
  }
  return text;
}

std::string TextTable::html() const {
  std::string text = "<table>\n<caption>" + html_escaped(title) + "</caption>\n";
  text += joined(escaped(header), "<tr><th>", "</th><th>", "</th></tr>\n");
  for (const auto& row : rows) text += joined(escaped(row), "<tr><td>", "</td><td>", "</td></tr>\n");
  return text + "</table>\n";
}

}  // namespace strainwave
