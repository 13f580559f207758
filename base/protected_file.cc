#include "base/protected_file.h"

#include <unistd.h>

#include <string>

#include "base/input_error.h"

namespace strainwave {

void require_protected(const std::filesystem::path& path, const struct stat& status, Writers allowed) {
  if (status.st_uid != 0 && status.st_uid != ::geteuid())
    throw InputError(path.string() + ": is owned by user " + std::to_string(status.st_uid) +
                     ": root or the user that runs strainwaved must own it");
  if (S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0) return;
  if ((status.st_mode & S_IWOTH) != 0)
    throw InputError(path.string() + ": everyone may write it: chmod o-w " + path.string());
  if (allowed == Writers::kNobody && (status.st_mode & S_IWGRP) != 0)
    throw InputError(path.string() + ": its group may write it: chmod g-w " + path.string());
}

void require_protected(const std::filesystem::path& path, Writers allowed) {
  struct stat status {};
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (::stat(folder.c_str(), &status) == 0) require_protected(folder, status, allowed);
  if (::stat(path.c_str(), &status) == 0) require_protected(path, status, allowed);
}

}  // namespace strainwave
