// SPDX-License-Identifier: BSD-3-Clause
// Why a program ends that can do nothing about it, and with which status.
#pragma once

#include <stdexcept>
#include <string>

#include "strainwave/exit_status.h"

namespace strainwave {

/// what() is the whole sentence for the user.
class ProgramError : public std::runtime_error {
 public:
  ProgramError(ExitStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace strainwave
