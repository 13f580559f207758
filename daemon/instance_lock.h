// SPDX-License-Identifier: BSD-3-Clause
// Allows one daemon per prefix, and one per drive, in a network namespace. The lock is a locked file in a directory that only
// our user can write. The kernel frees it however the process ends. Not real-time.
#pragma once

#include <filesystem>
#include <string>

#include "base/unique_fd.h"

namespace strainwave {

/// Returns the directory for locks, and makes it if it is missing. It is the service manager's ($RUNTIME_DIRECTORY), /run/strainwave
/// for root, else strainwave/ in $XDG_RUNTIME_DIR, else .strainwave/ in $HOME. Throws InputError if there is none of them, or if other
/// users may write into it, since they could keep the daemon from starting.
std::filesystem::path lock_directory();

class InstanceLock {
 public:
  /// Locks `name`. Throws InputError with `remedy` if another process holds it; lock_directory() may also throw.
  InstanceLock(const std::string& name, const std::string& remedy);

 private:
  UniqueFd file_;
};

}  // namespace strainwave
