// SPDX-License-Identifier: BSD-3-Clause
// The page that is served at /: its files from the installation's folder, read once at the start, and the words for faults and notices.
// Not real-time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace strainwave {

class WebPage {
 public:
  struct File {
    std::string type;  ///< of its content
    std::shared_ptr<const std::string> bytes;
  };

  /// Reads ../share/strainwave/web beside the program's own folder. A file that is missing there is not served.
  WebPage();

  /// The file for the path of a request, "/" or "/main.js"; null: there is none. No other file of the machine is ever read.
  const File* find(std::string_view path) const;

 private:
  std::map<std::string, File, std::less<>> files_;
};

/// The words and configuration keys of faults (by number) and notices (by bit) as JSON:
/// {"faults": {"5": {"text": "...", "key": "..."}}, "notices": {"1": {...}}}
std::string vocabulary_json();

}  // namespace strainwave
