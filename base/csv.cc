// SPDX-License-Identifier: BSD-3-Clause
#include "base/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/input_error.h"
#include "base/nearest_word.h"
#include "base/printable.h"
#include "base/text_file.h"

namespace strainwave {

namespace {

std::string joined(const std::vector<std::string>& columns) {
  std::string header;
  for (const std::string& column : columns) header += (header.empty() ? "" : ",") + column;
  return header;
}

/// Advice on converting the first column whose unit the project does not use; empty if there is none.
std::string conversion_of(const std::vector<std::string>& columns) {
  for (const std::string& column : columns)
    if (const std::string conversion = unit_conversion(column); !conversion.empty())
      return std::string(". ").append(column).append(":").append(conversion);
  return "";
}

/// Spreadsheets separate fields by semicolons or tabs in countries with a decimal comma.
void refuse_other_separators(std::string_view header, const std::string& where) {
  const std::size_t separator = header.find_first_of(";\t");
  if (header.find(',') != std::string_view::npos || separator == std::string_view::npos) return;
  throw InputError(where + ": " + (header[separator] == ';' ? "semicolons" : "tabs") +
                   " separate the fields: use commas, and a decimal point in numbers (0.5, not 0,5)");
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  for (const std::string_view field : split(line, ',')) fields.emplace_back(trimmed(field));
  return fields;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

/// True for control characters that text editors and spreadsheets never write.
bool is_no_text(char byte) {
  return static_cast<unsigned char>(byte) < ' ' &&
         std::string_view("\t\n\v\f\r").find(byte) == std::string_view::npos;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

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
    throw InputError(where, key, "\"" + std::string(text) + "\"", "must be a finite number");
  return value;
}

template <typename Field>
std::size_t CsvRows<Field>::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end())
    throw InputError(source + ": column " + name + " is missing; the columns are " + joined(columns) +
                     conversion_of(columns));
  return static_cast<std::size_t>(found - columns.begin());
}

template <typename Field>
void CsvRows<Field>::require_columns(const std::vector<std::string>& names) const {
  constexpr std::size_t kShown = 100;
  std::string header = joined(columns);
  if (header.size() > kShown) header = header.substr(0, kShown) + "...";
  if (columns != names)
    throw InputError(source + ":" + std::to_string(header_line), "header", header,
                     "must be '" + joined(names) + "'");
}

template struct CsvRows<std::string>;
template struct CsvRows<double>;

CsvText parse_csv_text(std::string_view text, const std::string& source) {
  if (std::any_of(text.begin(), text.end(), is_no_text))
    throw InputError(source +
                     ": is not a text file; a CSV file has lines of text with commas between the fields");
  CsvText table;
  table.source = source;
  int number = 0;
  for (const std::string_view raw : split(without_byte_order_mark(text), '\n')) {
    ++number;
    const std::string_view line = trimmed(raw);
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> fields = fields_of(line);
    const std::string where = source + ":" + std::to_string(number);
    if (table.columns.empty()) {
      refuse_other_separators(line, where);
      if (std::set<std::string>(fields.begin(), fields.end()).size() != fields.size())
        throw InputError(where, "header", std::string(line), "a column name occurs twice");
      table.columns = std::move(fields);
      table.header_line = number;
      continue;
    }
    if (fields.size() != table.columns.size())
      throw InputError(where + ": has " + counted(fields.size(), "field") + ", the header has " +
                       std::to_string(table.columns.size()) + " (" + joined(table.columns) + ")" +
                       (fields.size() > table.columns.size()
                            ? "; does a number have a decimal comma? Write a decimal point (0.5, not 0,5)"
                            : ""));
    table.rows.push_back(std::move(fields));
    table.line_numbers.push_back(number);
  }
  if (table.rows.empty())
    throw InputError(source + ": has no data: a header line and at least one row are needed");
  return table;
}

CsvTable parse_csv(std::string_view text, const std::string& source) {
  CsvText read = parse_csv_text(text, source);
  CsvTable table{source, std::move(read.columns), read.header_line, {}, std::move(read.line_numbers)};
  for (const std::vector<std::string>& fields : read.rows) {
    std::vector<double>& row = table.rows.emplace_back();
    const std::string where = table.place(table.rows.size() - 1);
    for (std::size_t i = 0; i < fields.size(); ++i)
      row.push_back(parse_number(fields[i], where, table.columns[i]));
  }
  return table;
}

CsvText read_csv_text(const std::filesystem::path& path) {
  return parse_csv_text(read_text_file(path), path.string());
}

CsvTable read_csv(const std::filesystem::path& path) {
  return parse_csv(read_text_file(path), path.string());
}

}  // namespace strainwave
