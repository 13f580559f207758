// SPDX-License-Identifier: BSD-3-Clause
// The output of a command for its results: a sentence for people, or with --json one object for scripts.
// Errors are exceptions. Not real-time.
#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace strainwave {

struct Output {
  std::ostream& stream;
  bool terminal = false;  ///< the stream is a terminal
  bool json = false;
};

/// Field names carry units. A number that is not finite becomes null.
using ResultField =
    std::pair<const char*, std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>,
                                        std::map<std::string, std::int64_t>>>;

/// Writes and flushes one line: `text`, or the fields as a JSON object.
void say(const Output& output, const std::string& text, const std::vector<ResultField>& fields);

}  // namespace strainwave
