// SPDX-License-Identifier: BSD-3-Clause
// The one exception for bad input at start-up or offline: configuration, tables, catalogues. Never in the loop.
#pragma once

#include <stdexcept>
#include <string>

#include "base/printable.h"

namespace strainwave {

/// what() is the complete sentence for the user: what is wrong, where, what is allowed and what to do. It may quote a file, a device
/// or a name, so terminal control characters other than line feeds become question marks.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(printable_lines(message)) {}
  /// "<where>: <key> = <value>: <allowed>".
  InputError(const std::string& where, const std::string& key, const std::string& value,
             const std::string& allowed)
      : InputError(where + ": " + key + " = " + printable(value) + ": " + allowed) {}
};

/// The request was valid and was tried, but failed: no such gains exist, or the disk is full. Programs end with
/// ExitStatus::kRefused.
class NotAchieved : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace strainwave
