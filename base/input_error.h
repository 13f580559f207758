// The one exception for bad input at start-up or offline: configuration, tables, catalogues. Never in the
// loop.
#pragma once

#include <stdexcept>
#include <string>

namespace strainwave {

/// Says what was wrong, where, what is allowed and what to do; what() is the whole sentence for the user.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// "<where>: <key> = <value>: <allowed>".
  InputError(const std::string& where, const std::string& key, const std::string& value,
             const std::string& allowed)
      : std::runtime_error(where + ": " + key + " = " + value + ": " + allowed) {}
};

}  // namespace strainwave
