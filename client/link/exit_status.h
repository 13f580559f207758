// How a command of strainwavectl could not be done. Not real-time.
#pragma once

#include <stdexcept>
#include <string>

#include "base/exit_status.h"

namespace strainwave {

/// what() is the whole sentence for the user and says what to do.
class ClientError : public std::runtime_error {
 public:
  ClientError(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace strainwave
