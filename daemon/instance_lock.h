// SPDX-License-Identifier: BSD-3-Clause
// One daemon per prefix, and one per drive, in a network namespace: a locked file in a directory that only we can write. The
// kernel frees the lock, however the process ends. Not real-time.
#pragma once

#include <filesystem>
#include <string>

#include "base/unique_fd.h"

namespace strainwave {

/// Where the locks are: the service manager's runtime directory ($RUNTIME_DIRECTORY), /run/strainwave for root, else
/// strainwave/ in $XDG_RUNTIME_DIR, else .strainwave/ in $HOME. Made if it is missing. Throws InputError: there is none of them,
/// or others than its owner may write it, who could keep the daemon from starting.
std::filesystem::path lock_directory();

class InstanceLock {
 public:
  /// Holds `name`. Throws InputError with `remedy` when another process holds it, or when lock_directory() does.
  InstanceLock(const std::string& name, const std::string& remedy);

 private:
  UniqueFd file_;
};

}  // namespace strainwave
