#include "design/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "base/input_error.h"
#include "base/text_file.h"

namespace strainwave {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', begin)) {
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  fields.push_back(trimmed(line.substr(begin)));
  return fields;
}

double parse_number(const std::string& field, const std::string& where) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
    throw InputError(where + " = \"" + field + "\": must be a finite number");
  }
  return value;
}

}  // namespace

std::size_t CsvTable::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) throw InputError(source + ": column " + name + " is missing");
  return static_cast<std::size_t>(found - columns.begin());
}

CsvTable parse_csv(const std::string& text, const std::string& source) {
  CsvTable table;
  table.source = source;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> fields = split(line);
    const std::string where = source + ", line " + std::to_string(number);
    if (table.columns.empty()) {
      if (std::set<std::string>(fields.begin(), fields.end()).size() != fields.size()) {
        throw InputError(where + ": a column name occurs twice");
      }
      table.columns = fields;
      continue;
    }
    if (fields.size() != table.columns.size()) {
      throw InputError(where + ": has " + std::to_string(fields.size()) + " fields, the header has " +
                       std::to_string(table.columns.size()));
    }
    std::vector<double> row;
    for (std::size_t i = 0; i < fields.size(); ++i)
      row.push_back(parse_number(fields[i], where + ", " + table.columns[i]));
    table.rows.push_back(std::move(row));
    table.line_numbers.push_back(number);
  }
  if (table.rows.empty())
    throw InputError(source + ": has no data: a header line and at least one row are needed");
  return table;
}

CsvTable read_csv(const std::filesystem::path& path) {
  return parse_csv(read_text_file(path), path.string());
}

}  // namespace strainwave
