// Strict reading of the project's CSV files: comment lines begin with '#', then one header line, then
// numbers. Offline.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strainwave {

struct CsvTable {
  std::string source;  ///< named in messages
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< each as long as `columns`, finite
  std::vector<int> line_numbers;          ///< of each row in the file

  /// Index of a column. Throws InputError when it is missing.
  std::size_t column(const std::string& name) const;
};

/// Throws InputError that names file and line: empty, no header, repeated columns, a row of another length,
/// anything that is not a finite number.
CsvTable parse_csv(const std::string& text, const std::string& source);
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace strainwave
