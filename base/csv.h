// SPDX-License-Identifier: BSD-3-Clause
// Strict reader of the project's CSV files. Comment lines begin with '#'. One header line comes before the rows, and each row has as many
// fields as the header. Not real-time.
#pragma once

#include <concepts>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

template <typename Field>
struct CsvRows {
  std::string source;  ///< name of the file in messages
  std::vector<std::string> columns;
  int header_line = 0;
  std::vector<std::vector<Field>> rows;  ///< each as long as `columns`
  std::vector<int> line_numbers;         ///< line of each row in the file, from 1

  /// Index of a column. Throws InputError that lists the existing columns if it is missing.
  std::size_t column(const std::string& name) const;
  /// Throws InputError unless the header is exactly `names`, in this order.
  void require_columns(const std::vector<std::string>& names) const;
  /// "file:line" of a row.
  std::string place(std::size_t row) const { return source + ":" + std::to_string(line_numbers.at(row)); }
};

using CsvText = CsvRows<std::string>;  ///< fields without surrounding blanks; quoting is not supported
using CsvTable = CsvRows<double>;      ///< finite numbers only

/// Throws InputError if the bytes are not text, and if the file has no row. Throws "file:line: ..." on repeated columns, a row of another
/// length and, for a CsvTable, a field that is not a finite number. A byte order mark is skipped.
CsvText parse_csv_text(std::string_view text, const std::string& source);
CsvTable parse_csv(std::string_view text, const std::string& source);
CsvText read_csv_text(const std::filesystem::path& path);
CsvTable read_csv(const std::filesystem::path& path);

/// Converts the whole of `text`. Throws InputError "<where>: <key> = <text>: must be a finite number".
double parse_number(std::string_view text, const std::string& where, const std::string& key);

/// `value` as a CSV file shows it. NaN loses its sign, which has no meaning and which some readers reject ("-nan").
template <typename Number>
constexpr Number csv_number(Number value) noexcept {
  if constexpr (std::floating_point<Number>)
    return value == value ? value : std::numeric_limits<Number>::quiet_NaN();
  else
    return value;
}

/// `text` without spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// `text` split at every `separator`; never empty.
std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace strainwave
