// SPDX-License-Identifier: BSD-3-Clause
// How many data members and methods the classes of a tree of sources have, by their definitions in the text.
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

/// Of every class and struct that `source` defines, nested ones on their own.
std::vector<ClassSize> class_sizes(const std::string& source);

/// One sentence for each class under `root` with more than `most_members` or `most_methods`: its name, its file, its sizes. Records,
/// with at most one method, may be wider.
std::vector<std::string> find_large_classes(const std::filesystem::path& root, int most_members,
                                            int most_methods);

}  // namespace strainwave::testing
