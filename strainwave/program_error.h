// SPDX-License-Identifier: BSD-3-Clause
// An error that ends a program, with the exit status.
#pragma once

#include <stdexcept>
#include <string>

#include "strainwave/exit_status.h"

namespace strainwave {

/// what() is a complete sentence for the user.
class ProgramError : public std::runtime_error {
 public:
  ProgramError(ExitStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace strainwave
