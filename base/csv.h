// Strict reader for small numeric CSV files. Offline or at start-up only.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// One row: its line in the file (from 1) and its fields in the order of the columns asked for.
struct CsvTextRow {
  int line = 0;
  std::vector<std::string> fields;
};
struct CsvRow {
  int line = 0;
  std::vector<double> values;
};

/// Reads a file whose header is exactly `columns`, comma separated. Lines that start with '#' and empty lines
/// are skipped. Throws InputError "<file>:<line>: ..." on another header, a wrong number of fields, and when
/// there is no row. Fields are not quoted.
std::vector<CsvTextRow> read_csv_text(const std::filesystem::path& path,
                                      const std::vector<std::string>& columns);

/// The same for finite numbers; anything else in a field is an InputError.
std::vector<CsvRow> read_csv(const std::filesystem::path& path, const std::vector<std::string>& columns);

/// The number that `text` is, whole; throws InputError "<where>: <key> = <text>: must be a finite number".
double parse_number(std::string_view text, const std::string& where, const std::string& key);

/// `text` split at every `separator`; never empty.
std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace strainwave
