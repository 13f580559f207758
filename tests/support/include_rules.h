// SPDX-License-Identifier: BSD-3-Clause
// Checks which folder may include what. The rules are in the table of docs/architecture.md. Which library may
// be included where is in include_rules.cc.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave::testing {

class IncludeRules {
 public:
  /// Reads the table with the columns "folder" and "may include" of `page`.
  explicit IncludeRules(const std::filesystem::path& page);

  std::size_t row_count() const noexcept { return rows_.size(); }

  /// The defect in `line`, a line of the source file `file` (path from the root, e.g.
  /// "daemon/config/config.cc"). Empty if the line has no defect or is no #include line.
  std::string find_defect(std::string_view file, std::string_view line) const;

  /// One sentence "<file>:<line>: ..." for every defect in the sources under `root`. Sources in a folder that
  /// is not in the table are defects, too.
  std::vector<std::string> find_defects(const std::filesystem::path& root) const;

  /// One sentence for every permission, of the table and of the libraries, that no source under `root` uses.
  std::vector<std::string> find_unused(const std::filesystem::path& root) const;

 private:
  struct Row {
    std::string name;
    std::vector<std::string> may_include;
  };
  const Row* row_of(std::string_view file) const;
  std::string check_our_header(std::string_view file, std::string_view header) const;
  void check_file(const std::filesystem::path& root, const std::filesystem::path& path,
                  std::vector<std::string>& defects) const;

  std::vector<Row> rows_;
};

/// Every C and C++ source under `root`, sorted, without those in folders such as build and .git.
std::vector<std::filesystem::path> sources_under(const std::filesystem::path& root);

}  // namespace strainwave::testing
