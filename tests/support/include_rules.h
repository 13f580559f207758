// Which folder may include what: the arrows of docs/architecture.md as a table, and a reader of #include
// lines that holds the tree against it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave::testing {

/// What is wrong with `line`, a line of the source file `file` (path from the root, e.g. "daemon/config/config.cc");
/// empty when nothing is, or when it is no #include line.
std::string find_include_defect(std::string_view file, std::string_view line);

/// One sentence "<file>:<line>: ..." for every defect in the sources under `root`. Sources in a folder that
/// the table does not know are defects, too. Folders that hold no sources of ours (build, .git) are not read.
std::vector<std::string> find_include_defects(const std::filesystem::path& root);

}  // namespace strainwave::testing
