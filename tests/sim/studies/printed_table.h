// Tables of the pages, as they are printed, for tests that hold their numbers.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace strainwave {

/// The fields after `name` of the first row of that name on a page of the source; none where there is no such row.
inline std::vector<std::string> printed_row(const std::filesystem::path& page, const std::string& name) {
  std::ifstream file(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / page);
  std::vector<std::string> fields;
  for (std::string line; fields.empty() && std::getline(file, line);) {
    if (line.rfind("| " + name + " |", 0) != 0) continue;
    std::istringstream rest(line.substr(name.size() + 4));
    for (std::string field; std::getline(rest, field, '|');) fields.push_back(field);
  }
  return fields;
}

/// The numbers >= 0 of a field, as they are printed.
inline std::vector<std::string> printed_numbers(const std::string& field) {
  const std::regex number("[0-9.]+(e[+-][0-9]+)?");
  return {std::sregex_token_iterator(field.begin(), field.end(), number), std::sregex_token_iterator()};
}

/// One unit of the last digit of a printed number: "12.6" has 0.1.
inline double last_digit(const std::string& printed) {
  const std::size_t point = printed.find('.');
  return point == std::string::npos ? 1.0 : std::pow(10.0, -static_cast<double>(printed.size() - point - 1));
}

}  // namespace strainwave
