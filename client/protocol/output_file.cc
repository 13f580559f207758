// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/output_file.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>

namespace strainwave {

UniqueFd claim_output(const std::filesystem::path& file, bool overwrite) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw ClientError(ExitStatus::kUsage, file.string() + ": is a folder: name a file");
  refuse_to_replace(file, overwrite);
  // Several programs may write to a pipe or a device.
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    return UniqueFd();
  UniqueFd claim(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (!claim) throw not_writable(file);
  // On a file system without locks, the claim always succeeds.
  if (::flock(claim.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw ClientError(
        ExitStatus::kUsage,
        file.string() +
            " is being written by another recorder: choose another name, or stop that recorder first");
  return claim;
}

}  // namespace strainwave
