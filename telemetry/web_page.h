// SPDX-License-Identifier: BSD-3-Clause
// The page at /: the files of the installed folder, read once at the start, and the words for faults and
// notices. Not real-time.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "telemetry/shared_text.h"

namespace strainwave {

class WebPage {
 public:
  struct File {
    std::string type;  ///< MIME type of its content
    SharedText text;
  };

  /// Reads ../share/strainwave/web beside the folder of the program; without it there is no page. `acting`: includes the script for orders.
  explicit WebPage(bool acting);

  /// Returns the file for the path of a request, "/" or "/main.js", or null. It never reads any other file of the machine.
  /// "/vocabulary.json" has the words and configuration keys of faults (by number) and notices (by bit):
  /// {"faults": {"5": {"text": "...", "key": "..."}}, "notices": {"1": {...}}}
  const File* find(std::string_view path) const;

 private:
  std::map<std::string, File, std::less<>> files_;
};

}  // namespace strainwave
