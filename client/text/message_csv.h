// SPDX-License-Identifier: BSD-3-Clause
// Messages as lines of CSV: each column has the name of its field (an array as name_0, name_1, ...). Numbers
// read back to the same bits. Text is quoted. Not real-time.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

#include "base/csv.h"
#include "base/printable.h"
#include "lcmtypes/message_fields.h"

namespace strainwave {

/// `text` in quotes, safe to show on a terminal and in a spreadsheet.
inline std::string csv_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char character : printable(text))
    quoted += character == '"' ? "\"\"" : std::string(1, character);
  return quoted + "\"";
}

/// Each column with a comma before it.
template <typename Message>
std::string csv_columns() {
  std::string line;
  visit_fields(Message{}, [&](const char* name, const auto& value) {
    constexpr bool is_text = std::same_as<std::decay_t<decltype(value)>, std::string_view>;
    if constexpr (!is_text && requires { value.size(); }) {
      for (std::size_t i = 0; i < value.size(); ++i) line += fmt::format(",{}_{}", name, i);
    } else {
      line += fmt::format(",{}", name);
    }
  });
  return line;
}

/// Each value with a comma before it.
template <typename Message>
std::string csv_values(const Message& message) {
  std::string line;
  visit_fields(message, [&](const char*, const auto& value) {
    if constexpr (std::same_as<std::decay_t<decltype(value)>, std::string_view>) {
      line += "," + csv_quoted(value);
    } else if constexpr (requires { value.size(); }) {
      for (const auto entry : value) line += fmt::format(",{}", csv_number(entry));
    } else {
      line += fmt::format(",{}", csv_number(value));
    }
  });
  return line;
}

}  // namespace strainwave
