// SPDX-License-Identifier: BSD-3-Clause
// The page that is served at /: the files of the installation's folder, read once at the start, and the words for faults and notices.
// Not real-time.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "telemetry/shared_text.h"

namespace strainwave {

class WebPage {
 public:
  struct File {
    std::string type;  ///< of its content
    SharedText text;
  };

  /// Reads ../share/strainwave/web beside the program's own folder; without it there is no page. `acting`: with what orders motions.
  explicit WebPage(bool acting);

  /// The file for the path of a request, "/" or "/main.js"; null: there is none. No other file of the machine is ever read.
  /// "/vocabulary.json" has the words and configuration keys of faults (by number) and notices (by bit):
  /// {"faults": {"5": {"text": "...", "key": "..."}}, "notices": {"1": {...}}}
  const File* find(std::string_view path) const;

 private:
  std::map<std::string, File, std::less<>> files_;
};

}  // namespace strainwave
