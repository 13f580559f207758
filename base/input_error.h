// SPDX-License-Identifier: BSD-3-Clause
// The one exception for bad input at start-up or offline: configuration, tables, catalogues. Never in the loop.
#pragma once

#include <stdexcept>
#include <string>

#include "base/printable.h"

namespace strainwave {

/// Says what was wrong, where, what is allowed and what to do; what() is the whole sentence for the user. It may quote what a file,
/// a device or a name says: whatever commands a terminal in it is shown as question marks, line by line.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(printable_lines(message)) {}
  /// "<where>: <key> = <value>: <allowed>".
  InputError(const std::string& where, const std::string& key, const std::string& value,
             const std::string& allowed)
      : InputError(where + ": " + key + " = " + printable(value) + ": " + allowed) {}
};

/// What was asked for makes sense and was tried, and did not come about: there are no such gains, the disk was full. Programs end with
/// ExitStatus::kRefused.
class NotAchieved : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace strainwave
