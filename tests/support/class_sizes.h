// SPDX-License-Identifier: BSD-3-Clause
// Counts the data members and methods of the classes in a source tree, from the text of their definitions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strainwave::testing {

struct ClassSize {
  std::string name;
  int members = 0;  ///< data, static constants excepted
  int methods = 0;  ///< declared in the class; constructors, destructors and assignments excepted
};

/// The sizes of every class and struct that `source` defines. Nested classes count separately.
std::vector<ClassSize> class_sizes(const std::string& source);

/// One sentence for each class under `root` with more than `most_members` or `most_methods`: its name, file
/// and sizes. Records, which have at most one method, may have more members.
std::vector<std::string> find_large_classes(const std::filesystem::path& root, int most_members,
                                            int most_methods);

}  // namespace strainwave::testing
