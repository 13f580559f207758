#include "base/csv.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string>

#include "base/input_error.h"

namespace strainwave {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string joined(const std::vector<std::string>& columns) {
  std::string header;
  for (const std::string& column : columns) header += (header.empty() ? "" : ",") + column;
  return header;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

double parse_number(std::string_view text, const std::string& where, const std::string& key) {
  const std::string_view digits = trimmed(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    throw InputError(where, key, std::string(text), "must be a finite number");
  return value;
}

std::vector<CsvTextRow> read_csv_text(const std::filesystem::path& path,
                                      const std::vector<std::string>& columns) {
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + ": cannot be read; check the path and its permissions");
  const std::string header = joined(columns);
  std::vector<CsvTextRow> rows;
  bool header_seen = false;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    const std::string where = path.string() + ":" + std::to_string(line);
    const std::string_view content = trimmed(text);
    if (content.empty() || content.front() == '#') continue;
    if (!header_seen) {
      if (content != header)
        throw InputError(where, "header", std::string(content), "must be '" + header + "'");
      header_seen = true;
      continue;
    }
    const auto fields = split(content, ',');
    if (fields.size() != columns.size())
      throw InputError(where, "fields", std::to_string(fields.size()),
                       "must be " + std::to_string(columns.size()) + " (" + header + ")");
    rows.push_back({line, {fields.begin(), fields.end()}});
  }
  if (rows.empty())
    throw InputError(path.string() + ": has no rows; expected '" + header + "' and at least one row");
  return rows;
}

std::vector<CsvRow> read_csv(const std::filesystem::path& path, const std::vector<std::string>& columns) {
  std::vector<CsvRow> rows;
  for (const CsvTextRow& text : read_csv_text(path, columns)) {
    CsvRow row{text.line, {}};
    const std::string where = path.string() + ":" + std::to_string(text.line);
    for (std::size_t i = 0; i < columns.size(); ++i)
      row.values.push_back(parse_number(text.fields[i], where, columns[i]));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace strainwave
